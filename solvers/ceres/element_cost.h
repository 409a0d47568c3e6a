#pragma once

#include <ceres/cost_function.h>
#include <ceres/loss_function.h>

#include <Eigen/Core>
#include <vector>

#include "energies/energy.h"
#include "solvers/ceres/trouble.h"

namespace deformlab {

/// The parameter block that begins at a column of X.
inline double* parameter_block(Unknowns& x, int column) { return x.X.col(column).data(); }

/// One element of one term over the parameter blocks that it depends on. Ceres may keep each block
/// anywhere, but an energy reads whole nodes, so their entries are gathered first.
class ElementCost final : public ceres::CostFunction {
 public:
  ///   weight     w, by whose root r is scaled
  ///   x          holds the parameter blocks
  ///   by_column  whether each column of a node is a block, and not the whole node
  ///   trouble    takes what goes wrong in `Evaluate`
  ElementCost(const Energy& energy, int e, double weight, Unknowns& x, bool by_column,
              Trouble& trouble);

  std::vector<double*> blocks() const;
  bool Evaluate(const double* const* x, double* residuals, double** jacobians) const override;

 private:
  /// The entries of the element's Jacobian that belong to one parameter block.
  struct Piece {
    int first, count;  ///< its columns in the Jacobian
    int size;          ///< of the block; the element does not read entries beyond `count`
    double* block;
  };

  int read(int a) const { return energy_.dimension() * energy_.argument(a).count; }
  std::vector<Piece> whole_nodes(Unknowns& x) const;
  std::vector<Piece> columns(Unknowns& x) const;
  bool evaluate(const double* const* x, double* residuals, double** jacobians) const;
  template <class Jacobian>
  void copy_blocks(const Jacobian& J, double** jacobians) const;

  const Energy& energy_;
  int e_;
  double scale_;
  Trouble& trouble_;
  std::vector<Piece> pieces_;
  Eigen::MatrixXd constant_;  ///< the Jacobian, unless it changes
};

/// w ρ(s), because the weight of a term is outside of its loss.
class WeightedLoss final : public ceres::LossFunction {
 public:
  ///   trouble  takes what goes wrong in `Evaluate`
  WeightedLoss(const ceres::LossFunction& loss, double weight, Trouble& trouble)
      : loss_(loss), weight_(weight), trouble_(trouble) {}

  void Evaluate(double s, double rho[3]) const override;

 private:
  const ceres::LossFunction& loss_;
  double weight_;
  Trouble& trouble_;
};

}  // namespace deformlab
