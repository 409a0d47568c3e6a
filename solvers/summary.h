#pragma once

#include <map>
#include <string>
#include <vector>

namespace deformlab {

enum class Status {
  kConverged,      ///< all three conditions of Eq. 12 hold
  kMaxIterations,  ///< max_iterations steps were not enough
  kStalled,        ///< no step along the search direction lowers F any more
  kFailed,         ///< no step could be computed: the message says why; x keeps its last value
};

const char* to_string(Status status);

/// One step of a solve, which becomes one row of the trace file.
struct Iteration {
  double cost = 0;          ///< F after the step
  double gradient_max = 0;  ///< ‖∇F‖∞ after the step
  double step_max = 0;      ///< ‖δ‖∞
  double step_scale = 1;    ///< share of the full step that was taken
  double damping = 0;       ///< λ
  double seconds = 0;       ///< of this iteration
};

/// What a solve did. The members mean the same for every method.
struct Summary {
  Status status = Status::kFailed;
  std::string message;  ///< why it ended, in words
  std::vector<std::string> notes;
  double initial_cost = 0;                     ///< F before the first step
  double final_cost = 0;                       ///< F of the result
  std::map<std::string, double> cost_by_term;  ///< w E of each term, by its name
  std::vector<Iteration> iterations;

  int unknowns = 0;
  long nonzeros_JtJ = 0;     ///< in the lower triangle
  long nonzeros_factor = 0;  ///< in L; 0 if the solver does not say
  int factorizations = 0;
  int cg_iterations = 0;                  ///< in all steps, if the linear solver iterates
  double condition = 0;                   ///< condition estimate of the preconditioned matrix
  std::map<std::string, double> seconds;  ///< by phase, such as evaluate, and in total

  std::string method, linear_solver, globalization;
  std::string choice;  ///< why `auto` took this linear solver
  std::string blas;
  int threads = 1;
};

}  // namespace deformlab
