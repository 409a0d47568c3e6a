#include "solvers/ceres/ceres_solver.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

#include "geometry/core/error.h"
#include "solvers/ceres/element_cost.h"
#include "solvers/compiled.h"
#include "solvers/linear/blas.h"
#include "solvers/linear/one_thread.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

// Records the iterations of Ceres like those of gauss_newton, and stops Ceres by Eq. 12.
class Recorder final : public ceres::IterationCallback {
 public:
  Recorder(const Unknowns& x, double epsilon, Summary& summary, Trouble& trouble)
      : x_(x.X), previous_(x.X), epsilon_(epsilon), summary_(summary), trouble_(trouble) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
    if (trouble_.thrown()) return ceres::SOLVER_ABORT;
    if (s.iteration == 0) return ceres::SOLVER_CONTINUE;
    Iteration iteration;
    iteration.cost = 2 * s.cost;
    iteration.gradient_max = 2 * s.gradient_max_norm;
    iteration.step_max = (x_ - previous_).cwiseAbs().maxCoeff();
    iteration.step_scale = s.step_is_successful ? 1 : 0;
    iteration.damping = s.trust_region_radius > 0 ? 1 / s.trust_region_radius : 0;
    iteration.seconds = s.iteration_time_in_seconds;
    summary_.iterations.push_back(iteration);
    previous_ = x_;
    if (!s.step_is_successful) return ceres::SOLVER_CONTINUE;
    trouble_.forget();
    const double before = iteration.cost + 2 * s.cost_change;
    const bool done =
        converged(iteration.cost, before, iteration.gradient_max, iteration.step_max, epsilon_);
    return done ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const Eigen::MatrixXd& x_;
  Eigen::MatrixXd previous_;
  double epsilon_;
  Summary& summary_;
  Trouble& trouble_;
};

std::string upper(std::string_view text) {
  std::string name(text);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name;
}

ceres::Solver::Options ceres_options(const SolverOptions& options) {
  ceres::Solver::Options o;
  const std::string linear =
      options.linear_solver == "auto" ? "sparse_normal_cholesky" : options.linear_solver;
  const bool known =
      ceres::StringToLinearSolverType(upper(linear), &o.linear_solver_type) &&
      ceres::StringToTrustRegionStrategyType(upper(name_of(options.ceres_trust_region)),
                                             &o.trust_region_strategy_type) &&
      ceres::StringToSparseLinearAlgebraLibraryType(upper(name_of(options.ceres_sparse_library)),
                                                    &o.sparse_linear_algebra_library_type);
  if (!known)
    throw InputError(fmt::format("this version of ceres does not know linear_solver {}", linear));
  o.max_num_iterations = options.max_iterations;
  o.function_tolerance = o.gradient_tolerance = o.parameter_tolerance = 0;  // Eq. 12 decides
  o.update_state_every_iteration = true;
  o.logging_type = ceres::SILENT;
  o.num_threads = options.threads;
  std::string error;
  if (!o.IsValid(&error))
    throw InputError(fmt::format("ceres does not take these options: {}", error));
  return o;
}

void conclude(const ceres::Solver::Summary& s, Summary& summary) {
  summary.message = s.message;
  switch (s.termination_type) {
    case ceres::USER_SUCCESS:
      summary.status = Status::kConverged;
      summary.message = "the three conditions of Eq. 12 hold";
      break;
    case ceres::CONVERGENCE:  // all tolerances are zero, so nothing changes any more
      summary.status = Status::kConverged;
      break;
    case ceres::NO_CONVERGENCE:
      summary.status = Status::kMaxIterations;
      break;
    default:
      summary.status = Status::kFailed;
  }
  summary.initial_cost = 2 * s.initial_cost;
  summary.final_cost = 2 * s.final_cost;
  summary.unknowns = s.num_effective_parameters_reduced;
  summary.factorizations = s.num_linear_solves;
  summary.threads = s.num_threads_used;
  summary.linear_solver = ceres::LinearSolverTypeToString(s.linear_solver_type_used);
  summary.seconds = {{"preprocess", s.preprocessor_time_in_seconds},
                     {"evaluate", s.residual_evaluation_time_in_seconds},
                     {"linearize", s.jacobian_evaluation_time_in_seconds},
                     {"factorize", s.linear_solver_time_in_seconds},
                     {"total", s.total_time_in_seconds}};
}

}  // namespace

CeresSolver::CeresSolver(const SolverOptions& options) : options_(options) {
  ceres_options(options);  // throws for a wrong option before any work
}

void CeresSolver::compile(const Problem& problem) {
  check(problem);
  ceres::Problem::Options ownership;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_ = std::make_unique<ceres::Problem>(ownership);
  losses_.clear();
  terms_ = problem.terms.size();
  x_ = problem.x;
  const bool by_column = options_.ceres_blocks == CeresBlocks::kColumn;
  for (int j = 0; j < x_.nodes(); ++j) {
    const int stride = by_column ? 1 : x_.columns(j);
    for (int c = x_.first[j]; c < x_.first[j + 1]; c += stride) {
      problem_->AddParameterBlock(parameter_block(x_, c), x_.dimension() * stride);
      if (problem.fixed[j]) problem_->SetParameterBlockConstant(parameter_block(x_, c));
    }
  }
  for (const WeightedEnergy& term : problem.terms) {
    if (term.weight > 0) add(term, by_column);
  }
}

void CeresSolver::add(const WeightedEnergy& term, bool by_column) {
  ceres::LossFunction* loss = nullptr;
  if (term.loss) {
    losses_.push_back(std::make_unique<WeightedLoss>(*term.loss, term.weight, trouble_));
    loss = losses_.back().get();
  }
  for (int e = 0; e < term.energy->size(); ++e) {
    auto cost = std::make_unique<ElementCost>(*term.energy, e, loss ? 1 : term.weight, x_,
                                              by_column, trouble_);
    const std::vector<double*> blocks = cost->blocks();
    problem_->AddResidualBlock(cost.release(), loss, blocks);
  }
}

Summary CeresSolver::solve(Problem& problem) {
  check_compiled(problem, problem_ ? &x_.first : nullptr, terms_);
  x_.X = problem.x.X;
  Summary summary;
  summary.method = "ceres";
  summary.globalization = name_of(options_.ceres_trust_region);
  summary.blas = blas_name();
  ceres::Solver::Options options = ceres_options(options_);
  trouble_.clear();
  Recorder recorder(x_, options_.epsilon, summary, trouble_);
  options.callbacks.push_back(&recorder);
  ceres::Solver::Summary result;
  {
    // Ceres does not pass num_threads on to CHOLMOD.
    const OneThread one_thread(options_.threads);
    ceres::Solve(options, problem_.get(), &result);
  }
  if (const std::exception_ptr thrown = trouble_.thrown()) std::rethrow_exception(thrown);
  conclude(result, summary);
  if (const Energy* term = trouble_.not_finite()) {
    // Ceres takes steps for converged that it has shortened until nothing changes.
    if (summary.status == Status::kConverged) summary.status = Status::kStalled;
    summary.message += not_finite_message(*term);
  }
  if (summary.status != Status::kFailed) problem.x.X = x_.X;
  const std::vector<double> costs = cost_by_term(problem, problem.x);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    summary.cost_by_term[std::string(problem.terms[i].energy->name())] = costs[i];
  }
  return summary;
}

}  // namespace deformlab
