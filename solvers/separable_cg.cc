#include "solvers/separable_cg.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "solvers/cholmod_view.h"
#include "solvers/linear_solver.h"
#include "solvers/one_thread.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr double kForcing = 0.1;  // η: the share of ‖r‖_{M⁻¹} that an inexact step leaves
constexpr int kMostIterations = 500;  // of one step
constexpr double kRidge = 1e-10;      // relative, where Ã is singular

SparseMatrix lower_matrix(std::size_t size, const std::vector<Eigen::Triplet<double>>& entries) {
  const auto n = static_cast<Eigen::Index>(size);
  SparseMatrix result(n, n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

SeparableCg::SeparableCg() {
  cholmod_start(&common_);
  common_.print = 0;
  common_.try_catch = 1;
}

SeparableCg::~SeparableCg() {
  cholmod_free_factor(&L_, &common_);
  cholmod_finish(&common_);
}

void SeparableCg::compile(const Stage& stage) {
  linearization_ = std::make_unique<Linearization>(stage);
  if (linearization_->unknowns() == 0) return;
  linearization_->evaluate(stage.x);
  linearization_->linearize(stage.x);
  number_columns();
  factorize(nearest_separable());
  const auto n = static_cast<Eigen::Index>(column_of_.size());
  for (Block* block : {&r_, &z_, &p_, &Hp_, &delta_, &D_}) *block = Block::Zero(4, n);
  for (const auto& part : linearization_->parts()) {
    const auto width = static_cast<std::size_t>(part.energy->jacobian_columns());
    local_.resize(std::max(local_.size(), width));
  }
}

// The free columns of X, as they come.
void SeparableCg::number_columns() {
  column_of_.clear();
  row_of_.assign(linearization_->columns(), -1);
  for (int c = 0; c < linearization_->columns(); ++c) {
    if (linearization_->place(0, c) < 0) continue;
    row_of_[c] = static_cast<int>(column_of_.size());
    column_of_.push_back(c);
  }
}

void SeparableCg::add_entry(Triplets& entries, int row, int column, double value) const {
  const int r = row_of_[row], c = row_of_[column];
  if (r >= 0 && c >= 0) entries.emplace_back(std::max(r, c), std::min(r, c), value);
}

void SeparableCg::add_separable(Triplets& entries) const {
  const SparseMatrix& A = linearization_->A();
  for (int c = 0; c < A.outerSize(); ++c) {
    for (SparseMatrix::InnerIterator it(A, c); it; ++it) {
      add_entry(entries, static_cast<int>(it.row()), c, it.value());
    }
  }
}

// Ã = A and, of the other terms' JᵀJ, the mean over the d coordinates.
SparseMatrix SeparableCg::nearest_separable() const {
  const int d = linearization_->dimension();
  Triplets entries;
  add_separable(entries);
  for (const auto& part : linearization_->parts()) {
    if (part.energy->structure() == Structure::kSeparable) continue;
    const int n = part.energy->jacobian_columns() / d;
    for (int e = 0; e < part.energy->size(); ++e) {
      const auto J = part.J.middleCols(std::ptrdiff_t(e) * n * d, n * d);
      const int* column = part.column.data() + std::ptrdiff_t(e) * n;
      for (int p = 0; p < n; ++p) {
        for (int q = 0; q <= p; ++q) {
          const double trace = J.middleCols(p * d, d).cwiseProduct(J.middleCols(q * d, d)).sum();
          add_entry(entries, column[p], column[q], part.weight * trace / d);
        }
      }
    }
  }
  for (int i = 0; i < static_cast<int>(column_of_.size()); ++i) entries.emplace_back(i, i, 0);
  return lower_matrix(column_of_.size(), entries);
}

// Factors Ã in a fill-reducing order, which the columns take over, so that nothing is permuted
// later.
void SeparableCg::factorize(const SparseMatrix& lower) {
  cholmod_sparse A = cholmod_view(lower);
  common_.supernodal = CHOLMOD_SUPERNODAL;
  cholmod_free_factor(&L_, &common_);
  L_ = cholmod_analyze(&A, &common_);
  if (L_ == nullptr) throw std::bad_alloc();
  double ridge[2] = {0, 0};
  const double largest = lower.diagonal().maxCoeff();
  const OneThread one_thread;
  for (double next = kRidge * (largest > 0 ? largest : 1); next < 1e300; next *= 1000) {
    cholmod_factorize_p(&A, ridge, nullptr, 0, L_, &common_);
    if (common_.status == CHOLMOD_OK && cholmod_rcond(L_, &common_) > kSingularRatio) break;
    ridge[0] = next;  // singular: some motion changes no term
  }
  if (!cholmod_change_factor(CHOLMOD_REAL, 1, 0, 1, 1, L_, &common_)) throw std::bad_alloc();

  const std::vector<int> natural = column_of_;
  for (std::size_t i = 0; i < natural.size(); ++i) {
    column_of_[i] = natural[static_cast<const int*>(L_->Perm)[i]];
    row_of_[column_of_[i]] = static_cast<int>(i);
  }
  Triplets entries;
  add_separable(entries);
  A_ = lower_matrix(column_of_.size(), entries);
}

void SeparableCg::gather(const Eigen::VectorXd& x, Block& block) const {
  const int d = linearization_->dimension();
  for (std::size_t i = 0; i < column_of_.size(); ++i) {
    block.col(i).head(d) = x.segment(linearization_->place(0, column_of_[i]), d);
  }
}

void SeparableCg::scatter(const Block& block, Eigen::VectorXd& x) const {
  const int d = linearization_->dimension();
  for (std::size_t i = 0; i < column_of_.size(); ++i) {
    x.segment(linearization_->place(0, column_of_[i]), d) = block.col(i).head(d);
  }
}

void SeparableCg::multiply(const Block& p, double damping, Block& Hp) {
  if (damping > 0) {
    Hp = damping * D_.cwiseProduct(p);
  } else {
    Hp.setZero();
  }
  for (int c = 0; c < A_.outerSize(); ++c) {
    const Eigen::Vector4d pc = p.col(c);
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (SparseMatrix::InnerIterator it(A_, c); it; ++it) {
      if (it.row() == c) {
        sum += it.value() * pc;
      } else {
        sum += it.value() * p.col(it.row());
        Hp.col(it.row()) += it.value() * pc;
      }
    }
    Hp.col(c) += sum;
  }
  for (const auto& part : linearization_->parts()) {
    if (part.energy->structure() != Structure::kSeparable) multiply_part(part, p, Hp);
  }
}

// Hp += w Jᵀ J p, element by element.
void SeparableCg::multiply_part(const Linearization::Part& part, const Block& p, Block& Hp) {
  const int d = linearization_->dimension(), rows = part.energy->rows();
  const int n = part.energy->jacobian_columns() / d;
  const int* column = part.column.data();
  const double* J = part.J.data();
  for (int e = 0; e < part.energy->size(); ++e, column += n, J += std::ptrdiff_t(rows) * n * d) {
    for (int c = 0; c < n; ++c) {
      const int at = row_of_[column[c]];
      for (int i = 0; i < d; ++i) local_[c * d + i] = at >= 0 ? p(i, at) : 0;
    }
    const Eigen::Map<const Eigen::MatrixXd> Je(J, rows, n * d);
    local_t_.head(rows).noalias() =
        part.weight * (Je * Eigen::Map<const Eigen::VectorXd>(local_.data(), n * d));
    for (int c = 0; c < n; ++c) {
      const int at = row_of_[column[c]];
      for (int i = 0; i < d && at >= 0; ++i)
        Hp(i, at) += Je.col(c * d + i).dot(local_t_.head(rows));
    }
  }
}

// z = Ã⁻¹ r for all coordinates at once: L y = r, Lᵀ z = y.
void SeparableCg::precondition(const Block& r, Block& z) const {
  const int* begin = static_cast<const int*>(L_->p);
  const int* row = static_cast<const int*>(L_->i);
  const double* value = static_cast<const double*>(L_->x);
  const auto n = static_cast<int>(L_->n);
  z = r;
  for (int c = 0; c < n; ++c) {
    const Eigen::Vector4d y = z.col(c) / value[begin[c]];
    z.col(c) = y;
    for (int k = begin[c] + 1; k < begin[c + 1]; ++k) z.col(row[k]) -= value[k] * y;
  }
  for (int c = n - 1; c >= 0; --c) {
    Eigen::Vector4d y = z.col(c);
    for (int k = begin[c] + 1; k < begin[c + 1]; ++k) y -= value[k] * z.col(row[k]);
    z.col(c) = y / value[begin[c]];
  }
}

bool SeparableCg::direction(double damping, const Eigen::VectorXd& D, Eigen::VectorXd& delta) {
  Stopwatch watch(work.solve_seconds);
  if (damping > 0) gather(D, D_);
  gather(linearization_->Jtr(), r_);
  r_ = -r_;
  delta_.setZero();
  precondition(r_, z_);
  p_ = z_;
  double rho = r_.cwiseProduct(z_).sum();
  const double enough = kForcing * kForcing * rho;
  for (int i = 0; i < kMostIterations && rho > enough; ++i) {
    multiply(p_, damping, Hp_);
    const double curvature = p_.cwiseProduct(Hp_).sum();
    if (!(curvature > 0)) return false;
    const double alpha = rho / curvature;
    delta_ += alpha * p_;
    r_ -= alpha * Hp_;
    precondition(r_, z_);
    const double before = std::exchange(rho, r_.cwiseProduct(z_).sum());
    p_ = z_ + (rho / before) * p_;
    ++work.cg_iterations;
  }
  scatter(delta_, delta);
  return delta.allFinite();
}

void SeparableCg::diagonal(Eigen::VectorXd& D) const {
  const int d = linearization_->dimension();
  for (std::size_t i = 0; i < column_of_.size(); ++i) {
    D.segment(linearization_->place(0, column_of_[i]), d).setConstant(A_.coeff(i, i));
  }
  for (const auto& part : linearization_->parts()) {
    if (part.energy->structure() == Structure::kSeparable) continue;
    const int n = part.energy->jacobian_columns() / d;
    for (std::ptrdiff_t k = 0; k < std::ptrdiff_t(part.energy->size()) * n; ++k) {
      for (int i = 0; i < d; ++i) {
        const int at = linearization_->place(i, part.column[k]);
        if (at >= 0) D[at] += part.weight * part.J.col(k * d + i).squaredNorm();
      }
    }
  }
}

long SeparableCg::nonzeros_factor() const {
  return L_ == nullptr ? 0 : static_cast<long>(static_cast<const int*>(L_->p)[L_->n]);
}

}  // namespace deformlab
