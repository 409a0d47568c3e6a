#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "solvers/stage.h"

namespace deformlab {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// A stage linearized: the residuals r of all its terms, each scaled by √w, and their derivative J,
/// kept term by term as each declares its structure. What is constant is computed once, here; after
/// construction nothing allocates.
class Linearization {
 public:
  /// Throws InputError for a term that reads nodes of another dimension or of too few columns.
  explicit Linearization(const Stage& stage);
  virtual ~Linearization() = default;

  /// F at x; its residuals stay for `linearize`.
  double evaluate(const Unknowns& x);
  /// w E of each term at the x that was last evaluated, in the stage's order.
  std::vector<double> cost_by_term() const;
  /// J and Jᵀr at the x that was last evaluated.
  virtual void linearize(const Unknowns& x);

  const Eigen::VectorXd& Jtr() const { return Jtr_; }  ///< n, half of ∇F
  int unknowns() const { return static_cast<int>(Jtr_.size()); }
  int dimension() const { return dimension_; }                                  ///< d
  int columns() const { return static_cast<int>(place_.size()) / dimension_; }  ///< of X
  /// The place among the unknowns of an entry of X, or −1 where its node is fixed.
  int place(int row, int column) const { return place_[column * dimension_ + row]; }

  /// to = from + scale · δ on the free entries.
  void step(const Unknowns& from, const Eigen::VectorXd& delta, double scale, Unknowns& to) const;

  /// One term's part.
  struct Part {
    const Energy* energy;
    double weight;
    Eigen::MatrixXd r;        ///< rows × elements
    Eigen::MatrixXd J;        ///< separable: coefficients a, one column an element; else Jacobians
    std::vector<int> column;  ///< columns of X that an element reads, arguments in turn
  };
  const std::vector<Part>& parts() const { return parts_; }

  /// The separable terms' JᵀJ is A ⊗ I_d: the lower triangle of A, over the columns of X.
  const SparseMatrix& A() const { return A_; }

 protected:
  std::vector<int> place_;  // of each entry of X

 private:
  void add_columns(const Unknowns& x, Part& part) const;
  void add_constant(const Unknowns& x, Part& part);
  void assemble_separable();
  void add_Jtr(const Part& part);

  int dimension_ = 0;
  std::vector<Part> parts_;
  SparseMatrix A_;
  Eigen::VectorXd Jtr_;
};

}  // namespace deformlab
