#include "solvers/ceres_solver.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/error.h"
#include "solvers/blas.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

// One element of one term. Ceres wants row-major Jacobians over whole parameter blocks.
class ElementCost final : public ceres::CostFunction {
 public:
  ElementCost(const Energy& energy, int e, double weight, const Unknowns& x)
      : energy_(energy), e_(e), scale_(std::sqrt(weight)) {
    set_num_residuals(energy.rows());
    std::vector<const double*> nodes;
    for (const int node : energy.nodes(e)) {
      nodes.push_back(x.node(node));
      mutable_parameter_block_sizes()->push_back(x.dimension() * x.columns(node));
    }
    if (energy.structure() == Structure::kNonlinear) return;
    constant_.resize(energy.rows(), energy.jacobian_columns());
    Eigen::VectorXd r(energy.rows());
    energy.evaluate(e, nodes.data(), r.data(), constant_.data());
  }

  bool Evaluate(const double* const* x, double* residuals, double** jacobians) const override {
    const bool differentiate = jacobians != nullptr && constant_.size() == 0;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxRows, kMaxWidth> J;
    if (differentiate) J.resize(energy_.rows(), energy_.jacobian_columns());
    energy_.evaluate(e_, x, residuals, differentiate ? J.data() : nullptr);
    Eigen::Map<Eigen::VectorXd> r(residuals, energy_.rows());
    r *= scale_;
    if (jacobians == nullptr) return r.allFinite();
    if (differentiate) {
      copy_blocks(J, jacobians);
    } else {
      copy_blocks(constant_, jacobians);
    }
    return r.allFinite();
  }

 private:
  static constexpr int kMaxRows = 16, kMaxWidth = 256;

  template <class Jacobian>
  void copy_blocks(const Jacobian& J, double** jacobians) const {
    for (int a = 0, first = 0; a < energy_.arity(); ++a) {
      const int read = energy_.dimension() * energy_.argument(a).count;
      if (jacobians[a] != nullptr) {
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> block(
            jacobians[a], energy_.rows(), parameter_block_sizes()[a]);
        block.leftCols(read) = scale_ * J.middleCols(first, read);
        block.rightCols(block.cols() - read).setZero();
      }
      first += read;
    }
  }

  const Energy& energy_;
  int e_;
  double scale_;
  Eigen::MatrixXd constant_;
};

// Records what Ceres does in our terms, and stops it by Eq. 12.
class Recorder final : public ceres::IterationCallback {
 public:
  Recorder(const Unknowns& x, double epsilon, Summary& summary)
      : x_(x.X), previous_(x.X), epsilon_(epsilon), summary_(summary) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
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
};

std::string upper(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name;
}

ceres::Solver::Options ceres_options(const SolverOptions& options) {
  ceres::Solver::Options o;
  const std::string linear =
      options.linear_solver == "auto" ? "sparse_normal_cholesky" : options.linear_solver;
  if (!ceres::StringToLinearSolverType(upper(linear), &o.linear_solver_type)) {
    throw InputError("solver.linear_solver '" + linear +
                     "' is not one of ceres'; known: auto, dense_qr, dense_normal_cholesky, "
                     "sparse_normal_cholesky, dense_schur, sparse_schur, iterative_schur, cgnr");
  }
  if (!ceres::StringToTrustRegionStrategyType(upper(options.ceres_trust_region),
                                              &o.trust_region_strategy_type) ||
      !ceres::StringToSparseLinearAlgebraLibraryType(upper(options.ceres_sparse_library),
                                                     &o.sparse_linear_algebra_library_type)) {
    throw InputError(
        "solver.ceres_trust_region is levenberg_marquardt or dogleg, and "
        "solver.ceres_sparse_library suite_sparse, eigen_sparse or cx_sparse");
  }
  o.max_num_iterations = options.max_iterations;
  o.function_tolerance = o.gradient_tolerance = o.parameter_tolerance = 0;  // Eq. 12 decides
  o.update_state_every_iteration = true;
  o.logging_type = ceres::SILENT;
  o.num_threads = 1;
  std::string error;
  if (!o.IsValid(&error)) throw InputError("ceres does not take these options: " + error);
  return o;
}

void conclude(const ceres::Solver::Summary& s, Summary& summary) {
  summary.message = s.message;
  switch (s.termination_type) {
    case ceres::USER_SUCCESS:
      summary.status = Status::kConverged;
      summary.message = "the three conditions of Eq. 12 hold";
      break;
    case ceres::CONVERGENCE:  // with all tolerances at zero: nothing changes any more
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
  ceres_options(options);  // rejects what is wrong before any work
}

void CeresSolver::compile(const Stage& stage) {
  problem_ = std::make_unique<ceres::Problem>();
  x_ = stage.x;
  for (int j = 0; j < x_.nodes(); ++j) {
    double* block = x_.X.data() + x_.X.rows() * x_.first[j];
    problem_->AddParameterBlock(block, x_.dimension() * x_.columns(j));
    if (stage.fixed[j]) problem_->SetParameterBlockConstant(block);
  }
  for (const auto& [energy, weight] : stage.terms) {
    if (weight == 0) continue;
    for (int e = 0; e < energy->size(); ++e) {
      std::vector<double*> blocks;
      for (const int node : energy->nodes(e)) {
        blocks.push_back(x_.X.data() + x_.X.rows() * x_.first[node]);
      }
      problem_->AddResidualBlock(new ElementCost(*energy, e, weight, x_), nullptr, blocks);
    }
  }
}

Summary CeresSolver::solve(Stage& stage) {
  x_.X = stage.x.X;
  Summary summary;
  summary.method = "ceres";
  summary.globalization = options_.ceres_trust_region;
  summary.blas = blas_name();
  ceres::Solver::Options options = ceres_options(options_);
  Recorder recorder(x_, options_.epsilon, summary);
  options.callbacks.push_back(&recorder);
  ceres::Solver::Summary result;
  ceres::Solve(options, problem_.get(), &result);
  conclude(result, summary);
  if (summary.status != Status::kFailed) stage.x.X = x_.X;
  for (const auto& [energy, weight] : stage.terms) {
    Eigen::VectorXd r(energy->rows() * energy->size());
    energy->residuals(stage.x, r.data());
    summary.cost_by_term[std::string(energy->name())] = weight * r.squaredNorm();
  }
  return summary;
}

}  // namespace deformlab
