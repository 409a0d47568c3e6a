#include "solvers/ceres/ceres_solver.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "energies/room.h"
#include "geometry/core/error.h"
#include "solvers/compiled.h"
#include "solvers/linear/blas.h"
#include "solvers/linear/one_thread.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

double* block(Unknowns& x, int column) { return x.X.col(column).data(); }

// The entries of an element's Jacobian that belong to one parameter block.
struct Piece {
  int first, count;  // its columns in the Jacobian
  int size;          // of the parameter block; the element does not read entries beyond `count`
  double* block;
};

// One element of one term over the parameter blocks that it depends on. Ceres may keep each block
// anywhere, but an energy reads whole nodes, so their entries are gathered first.
class ElementCost final : public ceres::CostFunction {
 public:
  ElementCost(const Energy& energy, int e, double weight, Unknowns& x, bool by_column)
      : energy_(energy), e_(e), scale_(std::sqrt(weight)) {
    set_num_residuals(energy.rows());
    std::vector<const double*> nodes;
    for (const int node : energy.nodes(e)) nodes.push_back(x.node(node));
    constant_.resize(energy.rows(), energy.jacobian_columns());
    Eigen::VectorXd r(energy.rows());
    energy.evaluate(e, nodes.data(), r.data(), constant_.data());
    const bool constant = energy.structure() != Structure::kNonlinear;
    for (const Piece& piece : by_column ? columns(x) : whole_nodes(x)) {
      if (constant && constant_.middleCols(piece.first, piece.count).isZero(0)) continue;
      pieces_.push_back(piece);
      mutable_parameter_block_sizes()->push_back(piece.size);
    }
    if (!constant) constant_.resize(0, 0);
  }

  std::vector<double*> blocks() const {
    std::vector<double*> result;
    for (const Piece& piece : pieces_) result.push_back(piece.block);
    return result;
  }

  bool Evaluate(const double* const* x, double* residuals, double** jacobians) const override {
    const int width = energy_.jacobian_columns();
    Room<double, kUsualWidth> entries(width);  // entries without a derivative may have any value
    std::fill_n(entries.data(), width, 0.0);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      std::copy_n(x[i], pieces_[i].count, entries.data() + pieces_[i].first);
    }
    Room<const double*, kUsualWidth> nodes(energy_.arity());
    for (int a = 0, first = 0; a < energy_.arity(); first += read(a++)) {
      nodes.data()[a] = entries.data() + first;
    }
    const bool differentiate = jacobians != nullptr && constant_.size() == 0;
    Room<double, kMaxResiduals * kUsualWidth> derivatives(energy_.rows() * width);
    Eigen::Map<Eigen::MatrixXd> J(derivatives.data(), energy_.rows(), width);
    energy_.evaluate(e_, nodes.data(), residuals, differentiate ? J.data() : nullptr);
    Eigen::Map<Eigen::VectorXd> r(residuals, energy_.rows());
    r *= scale_;
    if (jacobians != nullptr && differentiate) copy_blocks(J, jacobians);
    if (jacobians != nullptr && !differentiate) copy_blocks(constant_, jacobians);
    return r.allFinite();
  }

 private:
  static constexpr int kUsualWidth = 256;  // a wider Jacobian needs memory from the heap

  int read(int a) const { return energy_.dimension() * energy_.argument(a).count; }

  std::vector<Piece> whole_nodes(Unknowns& x) const {
    std::vector<Piece> result;
    for (int a = 0, first = 0; a < energy_.arity(); first += read(a++)) {
      const int node = energy_.nodes(e_)[a];
      result.push_back({first, read(a), x.dimension() * x.columns(node), block(x, x.first[node])});
    }
    return result;
  }

  std::vector<Piece> columns(Unknowns& x) const {
    std::vector<Piece> result;
    const int d = x.dimension();
    for (int a = 0; a < energy_.arity(); ++a) {
      const int begin = x.first[energy_.nodes(e_)[a]];
      for (int c = 0; c < energy_.argument(a).count; ++c) {
        result.push_back({d * static_cast<int>(result.size()), d, d, block(x, begin + c)});
      }
    }
    return result;
  }

  // Ceres wants a row-major Jacobian for each parameter block.
  template <class Jacobian>
  void copy_blocks(const Jacobian& J, double** jacobians) const {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Piece& piece = pieces_[i];
      if (jacobians[i] == nullptr) continue;
      double* to = jacobians[i];
      for (int row = 0; row < energy_.rows(); ++row, to += piece.size) {
        for (int k = 0; k < piece.count; ++k) to[k] = scale_ * J(row, piece.first + k);
        std::fill(to + piece.count, to + piece.size, 0.0);
      }
    }
  }

  const Energy& energy_;
  int e_;
  double scale_;
  std::vector<Piece> pieces_;
  Eigen::MatrixXd constant_;
};

// Records the iterations of Ceres like those of gauss_newton, and stops Ceres by Eq. 12.
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
      problem_->AddParameterBlock(block(x_, c), x_.dimension() * stride);
      if (problem.fixed[j]) problem_->SetParameterBlockConstant(block(x_, c));
    }
  }
  for (const WeightedEnergy& term : problem.terms) {
    if (term.weight > 0) add(term, by_column);
  }
}

// A loss is scaled by w, because the weight is outside of ρ. Without one, r is scaled by √w.
void CeresSolver::add(const WeightedEnergy& term, bool by_column) {
  ceres::LossFunction* loss = nullptr;
  if (term.loss) {
    losses_.push_back(std::make_unique<ceres::ScaledLoss>(term.loss.get(), term.weight,
                                                          ceres::DO_NOT_TAKE_OWNERSHIP));
    loss = losses_.back().get();
  }
  for (int e = 0; e < term.energy->size(); ++e) {
    auto cost =
        std::make_unique<ElementCost>(*term.energy, e, loss ? 1 : term.weight, x_, by_column);
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
  Recorder recorder(x_, options_.epsilon, summary);
  options.callbacks.push_back(&recorder);
  ceres::Solver::Summary result;
  {
    // Ceres does not pass num_threads on to CHOLMOD.
    const OneThread one_thread(options_.threads);
    ceres::Solve(options, problem_.get(), &result);
  }
  conclude(result, summary);
  if (summary.status != Status::kFailed) problem.x.X = x_.X;
  const std::vector<double> costs = cost_by_term(problem, problem.x);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    summary.cost_by_term[std::string(problem.terms[i].energy->name())] = costs[i];
  }
  return summary;
}

}  // namespace deformlab
