#pragma once

#include <vector>

#include "solvers/gauss_newton/linearization/free_columns.h"
#include "solvers/gauss_newton/linearization/kronecker_part.h"
#include "solvers/gauss_newton/linearization/linear_part.h"
#include "solvers/gauss_newton/linearization/nonlinear_part.h"
#include "solvers/linear/column_block.h"
#include "solvers/problem.h"

namespace deformlab {

/// How the free columns of X are numbered.
enum class ColumnOrder {
  kAsGiven,      ///< in their order in X
  kFillReducing  ///< so that a factor of A has few nonzeros
};

/// The linearization of a problem: the residuals r of all its terms, each scaled by √w, and their
/// derivative J, which is kept term by term as the structure of each one allows. The constructor
/// computes what is constant. Iterations allocate nothing.
///
/// The Kronecker terms are not evaluated along a direction, because their part of F is a quadratic
/// function that A determines.
class Linearization {
 public:
  /// Computes J at problem.x. Throws InputError for more than four coordinates.
  ///   problem  one that `check` accepts
  Linearization(const Problem& problem, ColumnOrder order);
  Linearization(const Linearization&) = delete;  // the parts refer to columns_
  Linearization& operator=(const Linearization&) = delete;

  /// Takes the elements that one Kronecker term has now: the problem is the one that was given to
  /// the constructor, except for this term's energy. Returns false, and changes nothing, unless
  /// A can follow by a change of low rank.
  bool change_elements(const Problem& problem, std::size_t term);

  /// Reads the current targets of the terms. Call it between Energy::set_targets and `evaluate`.
  void set_targets();
  /// Returns F at x, and keeps the residuals for `linearize`.
  double evaluate(const Unknowns& x);
  /// w E of each term at x, in the problem's order. After it, `evaluate` has to be called before
  /// `linearize`.
  std::vector<double> cost_by_term(const Unknowns& x);
  /// Computes J and Jᵀr at x, where F was evaluated last.
  void linearize(const Unknowns& x);

  /// Prepares steps along δ from the x that was linearized last.
  void set_direction(const Eigen::VectorXd& delta);
  /// to = x + scale · δ on the free entries.
  void step(const Unknowns& x, const Eigen::VectorXd& delta, double scale, Unknowns& to) const;
  /// F at `to` = x + scale · δ.
  double evaluate_step(const Unknowns& to, double scale);
  /// Computes J and Jᵀr at the `to` that was evaluated last, which is the new x. Returns F there.
  /// From time to time it evaluates all terms, so that rounding errors do not add up.
  double linearize_step(const Unknowns& to);

  /// q = Jᵀ (r(x + δ) − r(x) − J δ), where x is what was linearized last, and x + δ what was
  /// evaluated last. Up to third order in δ it is half of Jᵀ times the second derivative of r along
  /// δ (Transtrum and Sethna 2012).
  void second_order(const Unknowns& x, const Eigen::VectorXd& delta, Eigen::VectorXd& q);

  const Eigen::VectorXd& Jtr() const { return Jtr_; }   ///< n, half of ∇F
  int unknowns() const { return columns_.unknowns(); }  ///< n
  std::size_t terms() const { return structure_.size(); }
  const FreeColumns& columns() const { return columns_; }

  /// The Kronecker terms' JᵀJ is A ⊗ I_d. This is the lower triangle of A over the free columns, as
  /// it was when the constructor assembled it.
  const SparseMatrix& A() const { return A_; }
  /// How A has changed since.
  const LowRankChange& change_of_A() const { return change_of_A_; }
  /// The derivatives of the linear and the nonlinear terms.
  const std::vector<const ElementDerivatives*>& derivatives() const { return derivatives_; }
  /// The nonlinear terms. Their derivatives, which change, are the last ones above.
  const std::vector<NonlinearPart>& nonlinear_parts() const { return nonlinear_; }

  /// The lower triangle of C. C ⊗ I_d is the matrix of this form that is nearest, in the Frobenius
  /// norm, to what the other terms add to JᵀJ: C has the mean of the diagonal of each d×d block,
  /// and every entry of its own diagonal.
  SparseMatrix nearest_of_others() const;
  /// A lower triangle over the free columns with an entry wherever an element of the other terms
  /// reads both columns. It is only about terms that couple coordinates, or only about those that
  /// do not.
  SparseMatrix structure_of_others(bool couple_coordinates) const;

 private:
  double evaluate_others(const Unknowns& x);

  FreeColumns columns_;
  std::vector<KroneckerPart> kronecker_;
  std::vector<LinearPart> linear_;
  std::vector<NonlinearPart> nonlinear_;
  std::vector<const ElementDerivatives*> derivatives_;
  std::vector<Structure> structure_;  // of each term, in the problem's order
  SparseMatrix A_;
  LowRankChange change_of_A_;
  ColumnBlock X_, all_G_;  // X, and Jᵀr of the Kronecker terms over all columns
  ColumnBlock G_;          // the free ones in the order of their ranks
  ColumnBlock delta_, Adelta_;
  Eigen::VectorXd Jtr_;
  std::vector<double> scratch_;  // for the numbers that an element reads
  // The Kronecker terms' part of F at x, and its slope and curvature along δ.
  double kronecker_cost_ = 0, slope_ = 0, curvature_ = 0;
  // From the last evaluate_step: the step length, and the two parts of F.
  double scale_ = 0, trial_kronecker_cost_ = 0, trial_other_cost_ = 0;
  double exact_cost_ = 0;  // F where all residuals were last evaluated
};

}  // namespace deformlab
