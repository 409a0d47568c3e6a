#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "solvers/gauss_newton/kronecker_term.h"
#include "solvers/gauss_newton/linearization/node_blocks.h"
#include "solvers/linear/column_block.h"
#include "solvers/problem.h"

namespace deformlab {

/// A problem linearized: the residuals r of all its terms, each scaled by √w, and their derivative
/// J, kept term by term as each declares its structure. What is constant is computed once, here;
/// after construction nothing allocates.
///
/// Where a step leads, the Kronecker terms need not be evaluated: their share of F is quadratic,
/// and A knows how it changes.
///
/// Of a term with a loss, r and J of each element are scaled by √ρ′ at the last linearization, as
/// Ceres does it where ρ″ ≤ 0: Jᵀr is then half of ∇F, and JᵀJ leaves out what ρ″ would take off.
class Linearization {
 public:
  /// Throws InputError for a term that reads nodes of another dimension or of too few columns.
  explicit Linearization(const Problem& problem);
  virtual ~Linearization() = default;

  /// Takes over where the terms are drawn towards: called between Energy::set_targets and
  /// `evaluate`.
  void set_targets();
  /// F at x; its residuals stay for `linearize`.
  double evaluate(const Unknowns& x);
  /// w E of each term at x, in the problem's order. Nothing stays for `linearize`.
  std::vector<double> cost_by_term(const Unknowns& x);
  /// J and Jᵀr at the x that was last evaluated.
  void linearize(const Unknowns& x);

  /// Prepares steps along δ from the x that was linearized last.
  void set_direction(const Eigen::VectorXd& delta);
  /// F at `to` = x + scale · δ.
  double evaluate_step(const Unknowns& to, double scale);
  /// J and Jᵀr at the `to` that was evaluated last, which is the new x. Returns F there, free of
  /// the rounding that many steps add up.
  double linearize_step(const Unknowns& to);

  /// q = Jᵀ (r(to) − r(x) − J δ) for the direction δ and the `to` = x + δ that was evaluated last:
  /// how far the residuals bend away from their linearization. x is what was linearized last.
  void bend(const Unknowns& x, const Eigen::VectorXd& delta, Eigen::VectorXd& q);

  const Eigen::VectorXd& Jtr() const { return Jtr_; }  ///< n, half of ∇F
  int unknowns() const { return static_cast<int>(Jtr_.size()); }
  int dimension() const { return dimension_; }                      ///< d
  int columns() const { return static_cast<int>(rank_.size()); }    ///< of X
  int free_columns() const { return static_cast<int>(G_.cols()); }  ///< those of nodes not fixed
  /// The place among the unknowns of an entry of X, or −1 where its node is fixed.
  int place(int row, int column) const { return place_[column * dimension_ + row]; }
  /// The place of a column of X among the free ones, or −1. The d entries of a column are
  /// consecutive unknowns, in the order of the ranks, unless a derived class orders them otherwise.
  const std::vector<int>& rank() const { return rank_; }

  /// Ranks the free columns in a fill-reducing order of A. Before, they are as they come.
  void order_columns();
  /// Makes A, which has to be there before anything is evaluated along a direction. The last to be
  /// called of the two.
  void assemble();

  /// to = from + scale · δ on the free entries.
  void step(const Unknowns& from, const Eigen::VectorXd& delta, double scale, Unknowns& to) const;

  /// One term's part.
  struct Part {
    const Energy* energy = nullptr;
    double weight = 1;
    std::shared_ptr<const ceres::LossFunction> loss = nullptr;
    Eigen::MatrixXd r{};    ///< rows × elements; Kronecker: b as Energy has it
    Eigen::MatrixXd J{};    ///< Kronecker: coefficients a, one column an element; else Jacobians
    ColumnBlock b{};        ///< Kronecker: of the residuals X a − b
    Eigen::MatrixXd JtJ{};  ///< side by side and zeros behind, in place of J: of a term of one node
    Eigen::MatrixXd Jtr{};  ///< of every element, unless Kronecker
    Eigen::MatrixXd bent{};  ///< the same of `bend`, of nonlinear terms
    Eigen::VectorXd root{};  ///< √ρ′ of every element, which J has in it: of a term with a loss
    std::vector<int> column{};  ///< columns of X that an element reads, arguments in turn
    Structure structure() const { return loss ? Structure::kNonlinear : energy->structure(); }
    bool kronecker() const { return structure() == Structure::kKronecker; }
    KroneckerTerm as_kronecker() const { return {J, b, column.data()}; }
    bool square() const { return !loss && !kronecker() && energy->arity() == 1; }
  };
  const std::vector<Part>& parts() const { return parts_; }
  /// Not zero, of two free columns, where an element of such parts reads both; lower triangle.
  SparseMatrix structure_where(const std::function<bool(const Part&)>& such) const;

  /// The Kronecker terms' JᵀJ is A ⊗ I_d: the lower triangle of A, over the free columns.
  const SparseMatrix& A() const { return A_; }
  /// C of the nearest such matrix, in the Frobenius norm, to what the other terms add to JᵀJ where
  /// it was linearized last: each d×d block counts by its mean diagonal. Has all of its diagonal.
  SparseMatrix nearest_of_others() const;

  void gather(const Eigen::VectorXd& x, ColumnBlock& block) const;
  void scatter(const ColumnBlock& block, Eigen::VectorXd& x) const;

 protected:
  /// Called whenever J has changed.
  virtual void linearized() {}

  std::vector<int> place_;  // of each entry of X

 private:
  void number();
  void add_part(const Problem& problem, const WeightedEnergy& term);
  std::vector<const Part*> parts_where(const std::function<bool(const Part&)>& such) const;
  NodeBlocks blocks_of(const std::vector<const Part*>& parts) const;
  void sum_kronecker();
  double evaluate_others(const Unknowns& x);
  void add(const Part& part, const Eigen::MatrixXd& Jtr, Eigen::VectorXd& sum) const;

  int dimension_ = 0;
  std::vector<int> first_;  // column of each node
  std::vector<int> rank_;
  std::vector<Part> parts_;
  std::unique_ptr<NodeBlocks> blocks_;
  SparseMatrix A_;
  ColumnBlock X_, all_G_;  // X, and Jᵀr of the Kronecker terms over all columns
  ColumnBlock G_;          // the free ones in the order of their ranks
  ColumnBlock delta_, Adelta_;
  std::vector<double> local_;                         // an element's share of a direction
  double kronecker_ = 0, slope_ = 0, curvature_ = 0;  // their share of F, and how it changes
  double scale_ = 0, share_ = 0, others_ = 0;         // of the last evaluate_step
  double exact_ = 0;                                  // F where it was evaluated by residuals
  Eigen::VectorXd Jtr_;
};

}  // namespace deformlab
