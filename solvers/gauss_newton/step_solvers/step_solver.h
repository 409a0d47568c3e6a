#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "solvers/gauss_newton/linearization/linearization.h"
#include "solvers/linear/linear_solver.h"

namespace deformlab {

/// How the computation of a direction went, and what it cost.
struct StepResult {
  bool regular = true;   ///< false: the matrix is singular in double precision
  bool finished = true;  ///< false: conjugate gradients ended before they had converged
  int factorizations = 0;
  int cg_iterations = 0;
  double factorize_seconds = 0;
  double solve_seconds = 0;
  std::string note;  ///< what the user should know; empty in most cases
};

/// Computes the directions of Gauss–Newton steps, (JᵀJ + λ diag(D)) δ = −Jᵀr. The driver owns the
/// linearization; a step solver reads it and keeps what it derives from it.
class StepSolver {
 public:
  virtual ~StepSolver() = default;

  /// Called first, before the problem is linearized. Returns the order of the columns that suits
  /// this solver. Throws InputError if the terms do not suit it.
  virtual ColumnOrder prepare(const Problem& problem);
  /// Computes what depends on the structure alone. Called once for each linearization that is made.
  virtual void compile(const Linearization& linearization) = 0;
  /// Called after Linearization::change_elements. Returns false if this solver has to be compiled
  /// again.
  virtual bool change_elements(const Linearization&) { return false; }
  /// Called whenever J has changed.
  virtual void update(const Linearization& linearization);

  /// Computes δ where the problem was linearized last.
  ///   D  n, used if damping > 0
  virtual StepResult direction(const Linearization& linearization, double damping,
                               const Eigen::VectorXd& D, Eigen::VectorXd& delta) = 0;
  /// Computes c = −(JᵀJ)⁻¹ q where the last direction was computed. The matrix may have the damping
  /// of this direction.
  ///   q  n, Jᵀ times the second-order part of the residuals (Linearization::second_order)
  virtual StepResult geodesic_correction(const Linearization& linearization,
                                         const Eigen::VectorXd& q, Eigen::VectorXd& c) = 0;
  /// D = the diagonal of JᵀJ.
  void diagonal(const Linearization& linearization, Eigen::VectorXd& D) const;

  /// The value of solver.linear_solver for it.
  virtual std::string name() const = 0;
  /// Why it was chosen; empty unless the choice was automatic.
  virtual std::string reason() const { return ""; }
  /// The nonzeros of JᵀJ's lower triangle, as it is kept, and of the factor.
  virtual long nonzeros_JtJ(const Linearization& linearization) const = 0;
  virtual long nonzeros_factor() const = 0;
  /// The condition estimate of the preconditioned matrix from the last solve; 0 if there is no
  /// preconditioner.
  virtual double condition() const { return 0; }
  /// The number of threads that it uses.
  virtual int threads() const { return 1; }
};

/// Makes a step solver that may use this number of threads.
using StepSolverFactory = std::function<std::unique_ptr<StepSolver>(int threads)>;

/// Makes a linear solver that may use this number of threads.
using LinearSolverFactory = std::function<std::unique_ptr<LinearSolver>(int threads)>;

/// Makes `name` a value of solver.linear_solver. Throws InputError if the name is taken.
void register_step_solver(const std::string& name, StepSolverFactory factory);

/// The same for a linear solver. DirectSteps uses it to factor JᵀJ in each step.
void register_linear_solver(const std::string& name, const LinearSolverFactory& factory);

/// Makes "auto", "cholmod", "eigen_ldlt", "kronecker_cg", or a registered one. Throws InputError
/// for any other name; the message lists the known ones.
std::unique_ptr<StepSolver> make_step_solver(const std::string& name, int threads = 1);

/// The names that make_step_solver knows.
std::vector<std::string> step_solver_names();

}  // namespace deformlab
