#pragma once

#include <cholmod.h>

#include <memory>
#include <vector>

#include "solvers/step_solver.h"

namespace deformlab {

/// Directions by conjugate gradients on the exact JᵀJ, which is never assembled. The preconditioner
/// is Ã ⊗ I_d, the nearest such matrix to JᵀJ in the Frobenius norm at the state that was compiled:
/// the separable terms are A ⊗ I_d already, of the others each d×d block counts by its mean
/// diagonal. Ã has a d²-th of JᵀJ's entries and is factored once per compilation; a solve with it
/// takes all d coordinates of a column at once.
class SeparableCg final : public StepSolver {
 public:
  SeparableCg();
  ~SeparableCg() override;
  SeparableCg(const SeparableCg&) = delete;
  SeparableCg& operator=(const SeparableCg&) = delete;

  void compile(const Stage& stage) override;
  Linearization& linearization() override { return *linearization_; }
  /// Stops where the preconditioned residual has fallen to kForcing of its start.
  bool direction(double damping, const Eigen::VectorXd& D, Eigen::VectorXd& delta) override;
  void diagonal(Eigen::VectorXd& D) const override;
  long nonzeros_JtJ() const override { return A_.nonZeros(); }
  long nonzeros_factor() const override;

 private:
  // Coordinates beyond the d-th are zero: four at a time is what processors add best.
  using Block = Eigen::Matrix<double, 4, Eigen::Dynamic>;

  using Triplets = std::vector<Eigen::Triplet<double>>;

  void number_columns();
  void add_entry(Triplets& entries, int row, int column, double value) const;
  void add_separable(Triplets& entries) const;
  SparseMatrix nearest_separable() const;
  void factorize(const SparseMatrix& lower);
  void gather(const Eigen::VectorXd& x, Block& block) const;
  void scatter(const Block& block, Eigen::VectorXd& x) const;
  void multiply(const Block& p, double damping, Block& Hp);
  void multiply_part(const Linearization::Part& part, const Block& p, Block& Hp);
  void precondition(const Block& r, Block& z) const;

  std::unique_ptr<Linearization> linearization_;
  std::vector<int> row_of_;  // of each column of X its place in the preconditioner's order, or −1
  std::vector<int> column_of_;  // and back
  SparseMatrix A_;              // of the separable terms, in that order, lower triangle
  cholmod_common common_;
  cholmod_factor* L_ = nullptr;  // of Ã
  Block r_, z_, p_, Hp_, delta_, D_;
  std::vector<double> local_;  // an element's share of a block
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxResiduals, 1> local_t_{
      kMaxResiduals};
};

}  // namespace deformlab
