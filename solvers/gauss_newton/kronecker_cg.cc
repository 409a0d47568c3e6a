#include "solvers/gauss_newton/kronecker_cg.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr double kForcing = 0.02;     // an iteration that gains less than this share of all is last
constexpr int kMostIterations = 200;  // of one step
constexpr int kProbes = 4;            // iterations that show the condition
constexpr double kRidge = 1e-10;      // relative, where Ã is singular

}  // namespace

void KroneckerCg::compile(const Problem& problem) {
  linearization_ = std::make_unique<Linearization>(problem);
  if (linearization_->unknowns() == 0) return;
  linearization_->order_columns();
  linearization_->assemble();
  factorize();
  squares_.compile(*linearization_);
  for (ColumnBlock* block : {&r_, &z_, &p_, &Mp_, &Hp_, &delta_, &D_}) {
    *block = ColumnBlock::Zero(4, linearization_->free_columns());
  }
  for (const auto& part : linearization_->parts()) {
    const auto width = static_cast<std::size_t>(part.energy->jacobian_columns());
    local_.resize(std::max(local_.size(), width));
  }
}

void KroneckerCg::factorize() {
  const SparseMatrix& A = linearization_->A();
  SparseMatrix C = linearization_->nearest_of_others();
  SparseMatrix M = A + C;
  double largest = 0;
  for (int c = 0; c < M.cols(); ++c)
    largest = std::max(largest, M.valuePtr()[M.outerIndexPtr()[c]]);
  double ridge = kRidge * (largest > 0 ? largest : 1);
  factored_ = L_.factorize(M);
  for (; !factored_ && ridge < 1e300; ridge *= 1000) {  // singular: some motion changes no term
    for (int c = 0; c < C.cols(); ++c) C.valuePtr()[C.outerIndexPtr()[c]] += ridge;
    M = A + C;
    factored_ = L_.factorize(M);
  }
  minus_C_ = -C;
}

// H p = M p + (H − M) p. Of M p there is no need for a product, and what remains is sparser than A.
void KroneckerCg::multiply(double damping) {
  Hp_ = Mp_;
  if (damping > 0) Hp_ += damping * D_.cwiseProduct(p_);
  add_product(minus_C_, p_, Hp_);
  squares_.add_product(*linearization_, p_, Hp_);
  for (const auto& part : linearization_->parts()) {
    if (!part.kronecker() && !part.square()) multiply_part(part);
  }
}

// Hp += w Jᵀ J p, element by element.
void KroneckerCg::multiply_part(const Linearization::Part& part) {
  const int d = linearization_->dimension(), rows = part.energy->rows();
  const int n = part.energy->jacobian_columns() / d;
  const std::vector<int>& rank = linearization_->rank();
  const int* column = part.column.data();
  const double* J = part.J.data();
  for (int e = 0; e < part.energy->size(); ++e, column += n, J += std::ptrdiff_t(rows) * n * d) {
    for (int c = 0; c < n; ++c) {
      const int at = rank[column[c]];
      for (int i = 0; i < d; ++i) local_[c * d + i] = at >= 0 ? p_(i, at) : 0;
    }
    const Eigen::Map<const Eigen::MatrixXd> Je(J, rows, n * d);
    local_t_.head(rows).noalias() =
        part.weight * (Je * Eigen::Map<const Eigen::VectorXd>(local_.data(), n * d));
    for (int c = 0; c < n; ++c) {
      const int at = rank[column[c]];
      for (int i = 0; i < d && at >= 0; ++i) {
        Hp_(i, at) += Je.col(c * d + i).dot(local_t_.head(rows));
      }
    }
  }
}

bool KroneckerCg::direction(double damping, const Eigen::VectorXd& D, Eigen::VectorXd& delta) {
  if (damping > 0) linearization_->gather(D, D_);
  return solve(linearization_->Jtr(), damping, delta);
}

bool KroneckerCg::solve(const Eigen::VectorXd& gradient, double damping, Eigen::VectorXd& delta) {
  Stopwatch watch(work.solve_seconds);
  linearization_->gather(gradient, r_);
  r_ = -r_;
  if (!iterate(damping, kForcing, kMostIterations)) return false;
  linearization_->scatter(delta_, delta);
  return delta.allFinite();
}

// Conjugate gradients on H δ = r until an iteration lowers the model by no more than `forcing` of
// what all have: what is left is then about as little, and M need not be asked how much. Where r
// has grown since the start, matters are not as they seem, and it goes on. False where H turns
// out not to be positive definite, or M is none. As z is M⁻¹ r, M times a direction p = z + β p
// comes from r by the same recurrence.
bool KroneckerCg::iterate(double damping, double forcing, int most) {
  delta_.setZero();
  measured_ = 0;
  if (!factored_) return false;
  z_ = r_;
  L_.solve(z_);
  p_ = z_;
  Mp_ = r_;
  const double first = dot(r_, z_);
  double rho = first, gained = 0;
  double share = 0;  // β / α of the last iteration
  int i = 0;
  bool enough = !(rho > 0);
  while (i < most && !enough) {
    multiply(damping);
    const double curvature = dot(p_, Hp_);
    if (!(curvature > 0)) return false;
    const double alpha = rho / curvature;
    add_scaled(alpha, p_, delta_);
    gained += alpha * rho;
    enough = i++ > 0 && alpha * rho <= forcing * gained && rho <= first;
    if (measured_ < kMostMeasured) diagonal_[measured_++] = 1 / alpha + share;
    if (enough) break;
    add_scaled(-alpha, Hp_, r_);
    z_ = r_;
    L_.solve(z_);
    const double before = std::exchange(rho, dot(r_, z_)), beta = rho / before;
    enough = !(rho > 0);
    add_to_scaled(z_, beta, p_);
    add_to_scaled(r_, beta, Mp_);
    if (measured_ < kMostMeasured) beside_[measured_ - 1] = std::sqrt(beta) / alpha;
    share = beta / alpha;
  }
  work.cg_iterations += i;
  work.unfinished += !enough;
  return true;
}

// From a right-hand side that favours no motion.
void KroneckerCg::probe() {
  if (linearization_->unknowns() == 0) return;
  std::mt19937_64 random(1);
  for (Eigen::Index i = 0; i < r_.size(); ++i) {
    const bool used = i % 4 < linearization_->dimension();
    r_.data()[i] = used ? static_cast<double>(random() >> 11) / (1ULL << 53) - 0.5 : 0;
  }
  iterate(0, 0, kProbes);
  work = {};
}

// By Lanczos' relation: the coefficients of conjugate gradients are a tridiagonal matrix in
// disguise.
double KroneckerCg::condition() const {
  if (measured_ == 0) return 0;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
  eigen.computeFromTridiagonal(diagonal_.head(measured_), beside_.head(measured_ - 1),
                               Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().maxCoeff() / eigen.eigenvalues().minCoeff();
}

void KroneckerCg::diagonal(Eigen::VectorXd& D) const {
  const Linearization& l = *linearization_;
  const SparseMatrix& A = l.A();
  const int d = l.dimension();
  for (int c = 0; c < l.columns(); ++c) {
    for (int i = 0; i < d && l.rank()[c] >= 0; ++i) {
      D[l.place(i, c)] = A.valuePtr()[A.outerIndexPtr()[l.rank()[c]]];
    }
  }
  for (const auto& part : l.parts()) {
    if (part.kronecker()) continue;
    const int n = part.energy->jacobian_columns() / d;
    for (std::ptrdiff_t k = 0; k < std::ptrdiff_t(part.energy->size()) * n; ++k) {
      for (int i = 0; i < d; ++i) {
        const int at = l.place(i, part.column[k]);
        if (at < 0) continue;
        D[at] += part.weight * (part.square() ? part.JtJ(k % n * d + i, k * d + i)
                                              : part.J.col(k * d + i).squaredNorm());
      }
    }
  }
}

}  // namespace deformlab
