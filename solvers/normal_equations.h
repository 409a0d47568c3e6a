#pragma once

#include <Eigen/Core>
#include <vector>

#include "solvers/linear_solver.h"
#include "solvers/stage.h"

namespace deformlab {

/// The normal equations JᵀJ δ = −Jᵀr of a stage, with r the residuals of all terms, each scaled by
/// √w. What is constant is assembled once, here: all of JᵀJ but the nonlinear terms' share. After
/// construction and `reorder` nothing allocates.
class NormalEquations {
 public:
  /// Throws InputError for a term that reads nodes of another dimension or of too few columns.
  explicit NormalEquations(const Stage& stage);

  /// Puts unknown order[i] in place i, for a fill-reducing order of H's rows and columns.
  void reorder(const Eigen::VectorXi& order);

  /// F at x; its residuals stay for `linearize`.
  double evaluate(const Unknowns& x);
  /// w E of each term at the x that was last evaluated, in the stage's order.
  std::vector<double> cost_by_term() const;
  /// H = JᵀJ and Jᵀr at the x that was last evaluated.
  void linearize(const Unknowns& x);

  const SparseMatrix& H() const { return H_; }         ///< n×n, lower triangle
  const Eigen::VectorXd& Jtr() const { return Jtr_; }  ///< n, half of ∇F
  int unknowns() const { return static_cast<int>(Jtr_.size()); }
  /// The place in H's order of an entry of X, or −1 where its node is fixed.
  int place(int row, int column) const { return place_[column * dimension_ + row]; }

  /// to = from + scale · δ on the free entries.
  void step(const Unknowns& from, const Eigen::VectorXd& delta, double scale, Unknowns& to) const;

 private:
  // One term's part: its residuals, its derivative, and where its JᵀJ goes.
  struct Part {
    const Energy* energy;
    double weight;
    Eigen::MatrixXd r;        // rows × elements
    Eigen::MatrixXd J;        // separable: coefficients a, one column an element; else Jacobians
    std::vector<int> column;  // columns of X that an element reads, arguments in turn
    std::vector<int> target;  // nonlinear: index into H's values of each pair of an element
  };
  using Triplets = std::vector<Eigen::Triplet<double>>;

  void add_columns(const Unknowns& x, Part& part) const;
  void add_constant(const Unknowns& x, Part& part);
  void assemble_separable();
  void assemble_structure();
  template <class Visit>
  void for_each_pair(const Part& part, int e, Visit&& visit) const;
  void add_JtJ(const Part& part);
  void add_Jtr(const Part& part);

  int dimension_ = 0;
  std::vector<int> place_;  // of each entry of X
  std::vector<Part> parts_;
  SparseMatrix A_;  // lower triangle over the columns of X: the separable terms are A ⊗ I_d
  SparseMatrix H_;
  Eigen::VectorXd constant_;  // H's values without the nonlinear terms
  Eigen::VectorXd Jtr_;
};

}  // namespace deformlab
