#pragma once

#include <Eigen/Core>
#include <vector>

#include "solvers/gauss_newton/linearization/free_columns.h"
#include "solvers/linear/column_block.h"

namespace deformlab {

class NodeBlocks;

/// The derivatives of a term that is not Kronecker: for each element Jᵀr, and either J or JᵀJ. JᵀJ
/// is smaller if an element reads only one node.
class ElementDerivatives {
 public:
  ///   squared  whether JᵀJ is kept instead of J
  ElementDerivatives(const WeightedEnergy& term, const Unknowns& x, const FreeColumns& columns,
                     bool squared);

  /// Computes J at x or, if squared, JᵀJ and Jᵀr.
  void compute(const Unknowns& x);
  /// Multiplies J of every element by its factor. Only if J is kept.
  void scale(const Eigen::VectorXd& factors);
  /// Computes Jᵀr of every element. Only if J is kept.
  ///   r  rows × elements
  void multiply_transposed(const Eigen::MatrixXd& r, Eigen::MatrixXd& Jtr) const;

  const Energy& energy() const { return *energy_; }
  double weight() const { return weight_; }
  bool squared() const { return squared_; }
  /// How many entries of X an element reads: the number of columns of its J.
  int width() const { return width_; }
  /// Whether elements couple different coordinates. A term that only its loss makes nonlinear does
  /// not.
  bool couples_coordinates() const { return energy_->structure() != Structure::kKronecker; }
  /// The columns of X that element e reads, width() / d of them.
  const int* columns_read(int e) const {
    return column_.data() + std::ptrdiff_t(e) * (width_ / energy_->dimension());
  }

  Eigen::MatrixXd& Jtr() { return Jtr_; }  ///< width × elements
  const Eigen::MatrixXd& Jtr() const { return Jtr_; }
  /// One entry of an element's JᵀJ.
  double JtJ(int e, int p, int q) const {
    const std::ptrdiff_t first = std::ptrdiff_t(e) * width_;
    return squared_ ? JtJ_(p, first + q) : J_.col(first + p).dot(J_.col(first + q));
  }
  /// Adds the mean of the diagonal of each d×d block of w JᵀJ.
  ///   index  of this energy among those of the blocks
  void add_mean_diagonals(std::size_t index, NodeBlocks& blocks) const;

  /// Adds w times the vectors of all elements, such as their Jᵀr, to a vector over the unknowns.
  ///   own  the vectors, width × elements
  void add(const Eigen::MatrixXd& own, Eigen::VectorXd& sum) const;
  /// own −= JᵀJ δ of every element.
  ///   scratch  room for width() numbers
  void subtract_JtJ(const Eigen::VectorXd& delta, Eigen::MatrixXd& own, double* scratch) const;
  /// Hp += w JᵀJ p.
  void add_product(const ColumnBlock& p, ColumnBlock& Hp, double* scratch) const;
  /// D += the diagonal of w JᵀJ.
  void add_diagonal(Eigen::VectorXd& D) const;

 private:
  void add_node_product(const ColumnBlock& p, ColumnBlock& Hp) const;
  void add_element_product(const ColumnBlock& p, ColumnBlock& Hp, double* scratch) const;

  const Energy* energy_;
  const FreeColumns* columns_;
  double weight_;
  bool squared_;
  int width_;
  std::vector<int> column_, rank_;  // the columns of X that the elements read, and their ranks
  Eigen::MatrixXd J_, JtJ_, Jtr_;
};

}  // namespace deformlab
