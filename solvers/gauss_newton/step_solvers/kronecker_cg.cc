#include "solvers/gauss_newton/step_solvers/kronecker_cg.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "geometry/core/error.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr double kForcing = 0.02;     // stops when an iteration gains no more than this share
constexpr int kMostIterations = 200;  // of one step
constexpr int kConditionIterations = 4;
// With a ratio of its eigenvalues below this, a removed element was almost all that held a motion.
constexpr double kSingularCapacitance = 1e-12;
constexpr double kRidge = 1e-10;  // the first relative damping of a singular Ã

}  // namespace

ColumnOrder KroneckerCg::prepare(const Problem& problem) {
  std::vector<std::string_view> names;
  for (const WeightedEnergy& term : problem.terms) {
    if (term.structure() == Structure::kKronecker) return ColumnOrder::kFillReducing;
    names.push_back(term.energy->name());
  }
  if (names.empty()) return ColumnOrder::kFillReducing;
  throw InputError(
      fmt::format("solver.linear_solver is kronecker_cg, but of the terms ({}) none is Kronecker; "
                  "use auto, cholmod or eigen_ldlt",
                  fmt::join(names, ", ")));
}

void KroneckerCg::compile(const Linearization& linearization) {
  if (linearization.unknowns() == 0) return;
  factorize(linearization);
  for (ColumnBlock* block : {&r_, &z_, &p_, &Mp_, &Hp_, &delta_, &D_}) {
    *block = ColumnBlock::Zero(4, linearization.columns().count());
  }
  for (const ElementDerivatives* part : linearization.derivatives()) {
    scratch_.resize(std::max(scratch_.size(), std::size_t(part->width())));
  }
}

void KroneckerCg::factorize(const Linearization& linearization) {
  const SparseMatrix& A = linearization.A();
  SparseMatrix C = linearization.nearest_of_others();
  SparseMatrix M = A + C;
  double largest = 0;
  for (int c = 0; c < M.cols(); ++c) {
    largest = std::max(largest, M.valuePtr()[M.outerIndexPtr()[c]]);
  }
  double ridge = kRidge * (largest > 0 ? largest : 1);
  factored_ = L_.factorize(M);
  for (; !factored_ && ridge < 1e300; ridge *= 1000) {  // singular: some motion changes no term
    for (int c = 0; c < C.cols(); ++c) C.valuePtr()[C.outerIndexPtr()[c]] += ridge;
    M = A + C;
    factored_ = L_.factorize(M);
  }
  minus_C_ = -C;
}

// The formula is exact where Ã + U S Uᵀ is positive definite. By Sylvester's law of inertia it is
// so if S⁻¹ + Uᵀ Y has as many negative eigenvalues as S.
bool KroneckerCg::change_elements(const Linearization& linearization) {
  if (!factored_) return false;
  const LowRankChange& change = linearization.change_of_A();
  const int r = change.rank();
  Yt_.resize(r, linearization.columns().count());
  capacitance_inverse_.resize(r, r);
  for (int first = 0; first < r; first += 4) {
    const int count = std::min(4, r - first);
    z_.setZero();
    for (int i = 0; i < count; ++i) {
      for (const auto& [rank, value] : change.vectors()[first + i].u) z_(i, rank) = value;
    }
    L_.solve(z_);
    Yt_.middleRows(first, count) = z_.topRows(count);
    for (int i = 0; i < r; ++i) {
      capacitance_inverse_.row(i).segment(first, count) =
          product(change.vectors()[i].u, z_).head(count);
    }
  }
  for (int i = 0; i < r; ++i) capacitance_inverse_(i, i) += 1 / change.vectors()[i].s;
  if (r == 0) return true;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(capacitance_inverse_);
  const Eigen::ArrayXd values = eigen.eigenvalues();
  if ((values < 0).count() != change.negative()) return false;
  if (!(values.abs().minCoeff() > kSingularCapacitance * values.abs().maxCoeff())) return false;
  capacitance_inverse_ = eigen.eigenvectors() * values.inverse().matrix().asDiagonal() *
                         eigen.eigenvectors().transpose();
  return true;
}

// z ← M⁻¹ z.
void KroneckerCg::precondition(const Linearization& linearization) {
  L_.solve(z_);
  const auto& vectors = linearization.change_of_A().vectors();
  if (vectors.empty()) return;
  projected_.resize(4, std::ssize(vectors));
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    projected_.col(static_cast<Eigen::Index>(i)) = product(vectors[i].u, z_);
  }
  projected_ = (projected_ * capacitance_inverse_).eval();
  z_.noalias() -= projected_.lazyProduct(Yt_);
}

// H p = M p + (H − M) p. M p is known without a product, and H − M is sparser than A.
void KroneckerCg::multiply(const Linearization& linearization, double damping) {
  Hp_ = Mp_;
  if (damping > 0) Hp_ += damping * D_.cwiseProduct(p_);
  add_product(minus_C_, p_, Hp_);
  for (const ElementDerivatives* part : linearization.derivatives()) {
    part->add_product(p_, Hp_, scratch_.data());
  }
}

StepResult KroneckerCg::direction(const Linearization& linearization, double damping,
                                  const Eigen::VectorXd& D, Eigen::VectorXd& delta) {
  if (damping > 0) gather(D, linearization.columns().dimension(), D_);
  return solve(linearization, linearization.Jtr(), damping, delta);
}

StepResult KroneckerCg::geodesic_correction(const Linearization& linearization,
                                            const Eigen::VectorXd& q, Eigen::VectorXd& c) {
  return solve(linearization, q, 0, c);
}

StepResult KroneckerCg::solve(const Linearization& linearization, const Eigen::VectorXd& gradient,
                              double damping, Eigen::VectorXd& delta) {
  double seconds = 0;
  StepResult result;
  {
    Stopwatch watch(seconds);
    const int d = linearization.columns().dimension();
    gather(gradient, d, r_);
    r_ = -r_;
    result = iterate(linearization, damping, kForcing, kMostIterations);
    if (result.regular) {
      scatter(delta_, d, delta);
      result.regular = delta.allFinite();
    }
  }
  result.solve_seconds = seconds;
  return result;
}

// Conjugate gradients on H δ = r. They end when an iteration lowers the quadratic model by no more
// than the share `forcing` of the gain of all iterations, because the remaining gain is then about
// as small. If ⟨r, M⁻¹r⟩ has grown since the start, the gains say little, and the iteration goes
// on. The matrix counts as singular if H turns out not to be positive definite, or if there is no
// factor of M. M p needs no product: since z = M⁻¹ r, it follows from r as p follows from z.
StepResult KroneckerCg::iterate(const Linearization& linearization, double damping, double forcing,
                                int most) {
  StepResult result;
  delta_.setZero();
  measured_ = 0;
  result.regular = factored_;
  if (!factored_) return result;
  z_ = r_;
  precondition(linearization);
  p_ = z_;
  Mp_ = r_;
  const double first = dot(r_, z_);
  double rho = first, gained = 0;
  double share = 0;  // β / α of the last iteration
  int i = 0;
  bool enough = !(rho > 0);
  while (i < most && !enough) {
    multiply(linearization, damping);
    const double curvature = dot(p_, Hp_);
    result.regular = curvature > 0;
    if (!result.regular) return result;
    const double alpha = rho / curvature;
    add_scaled(alpha, p_, delta_);
    gained += alpha * rho;
    enough = i++ > 0 && alpha * rho <= forcing * gained && rho <= first;
    if (measured_ < kMostMeasured) diagonal_[measured_++] = 1 / alpha + share;
    if (enough) break;
    add_scaled(-alpha, Hp_, r_);
    z_ = r_;
    precondition(linearization);
    const double before = std::exchange(rho, dot(r_, z_)), beta = rho / before;
    enough = !(rho > 0);
    add_to_scaled(z_, beta, p_);
    add_to_scaled(r_, beta, Mp_);
    if (measured_ < kMostMeasured) beside_[measured_ - 1] = std::sqrt(beta) / alpha;
    share = beta / alpha;
  }
  result.cg_iterations = i;
  result.finished = enough;
  return result;
}

// Starts from a random right-hand side, which favours no motion.
double KroneckerCg::estimate_condition(const Linearization& linearization) {
  if (linearization.unknowns() == 0) return 0;
  std::mt19937_64 random(1);
  for (Eigen::Index i = 0; i < r_.size(); ++i) {
    const bool used = i % 4 < linearization.columns().dimension();
    r_.data()[i] = used ? static_cast<double>(random() >> 11) / (1ULL << 53) - 0.5 : 0;
  }
  iterate(linearization, 0, 0, kConditionIterations);
  return condition();
}

// By Lanczos' relation, the coefficients of conjugate gradients give a tridiagonal matrix whose
// extreme eigenvalues approach those of the preconditioned matrix.
double KroneckerCg::condition() const {
  if (measured_ == 0) return 0;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
  eigen.computeFromTridiagonal(diagonal_.head(measured_), beside_.head(measured_ - 1),
                               Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().maxCoeff() / eigen.eigenvalues().minCoeff();
}

}  // namespace deformlab
