#include "solvers/gauss_newton/linearization/element_derivatives.h"

#include "solvers/gauss_newton/linearization/node_blocks.h"

namespace deformlab {
namespace {

// The products with JᵀJ read four numbers at a time, up to this many columns beyond the last block.
constexpr int kReadBeyond = 4;

}  // namespace

ElementDerivatives::ElementDerivatives(const WeightedEnergy& term, const Unknowns& x,
                                       const FreeColumns& columns, bool squared)
    : energy_(term.energy.get()),
      columns_(&columns),
      weight_(term.weight),
      squared_(squared),
      width_(energy_->jacobian_columns()),
      column_(deformlab::columns_read(*energy_, columns)),
      Jtr_(width_, energy_->size()) {
  for (const int column : column_) rank_.push_back(columns.rank(column));
  const std::ptrdiff_t all = std::ptrdiff_t(width_) * energy_->size();
  if (squared_) JtJ_.setZero(width_, all + kReadBeyond);
  if (!squared_) J_.resize(energy_->rows(), all);
  compute(x);
}

void ElementDerivatives::compute(const Unknowns& x) {
  if (squared_) {
    energy_->normal_equations(x, JtJ_.data(), Jtr_.data());
  } else {
    energy_->jacobians(x, J_.data());
  }
}

void ElementDerivatives::scale(const Eigen::VectorXd& factors) {
  for (Eigen::Index e = 0; e < factors.size(); ++e) {
    J_.middleCols(width_ * e, width_) *= factors[e];
  }
}

void ElementDerivatives::multiply_transposed(const Eigen::MatrixXd& r, Eigen::MatrixXd& Jtr) const {
  for (Eigen::Index e = 0; e < Jtr.cols(); ++e) {
    const auto J = J_.middleCols(width_ * e, width_);
    for (Eigen::Index p = 0; p < width_; ++p) Jtr(p, e) = J.col(p).dot(r.col(e));
  }
}

void ElementDerivatives::add_mean_diagonals(std::size_t index, NodeBlocks& blocks) const {
  if (squared_) return blocks.add_mean_diagonals(index, weight_, JtJ_);
  Eigen::MatrixXd JtJ(width_, J_.cols());
  for (Eigen::Index c = 0; c < J_.cols(); c += width_) {
    const auto J = J_.middleCols(c, width_);
    JtJ.middleCols(c, width_) = J.transpose() * J;
  }
  blocks.add_mean_diagonals(index, weight_, JtJ);
}

void ElementDerivatives::add(const Eigen::MatrixXd& own, Eigen::VectorXd& sum) const {
  const int d = columns_->dimension();
  const double* entry = own.data();
  for (const int rank : rank_) {
    for (int i = 0; i < d; ++i, ++entry) {
      if (rank >= 0) sum[d * rank + i] += weight_ * *entry;
    }
  }
}

void ElementDerivatives::subtract_JtJ(const Eigen::VectorXd& delta, Eigen::MatrixXd& own,
                                      double* scratch) const {
  const int d = columns_->dimension();
  Eigen::Map<Eigen::VectorXd> x(scratch, width_);
  for (int e = 0; e < energy_->size(); ++e) {
    const std::ptrdiff_t first = std::ptrdiff_t(e) * width_;
    for (int p = 0; p < width_; ++p) {
      const int rank = rank_[(first + p) / d];
      x[p] = rank < 0 ? 0 : delta[d * rank + p % d];
    }
    if (squared_) {
      own.col(e).noalias() -= JtJ_.middleCols(first, width_).lazyProduct(x);
    } else {
      const auto J = J_.middleCols(first, width_);
      for (Eigen::Index row = 0; row < J.rows(); ++row) {
        own.col(e) -= J.row(row).dot(x) * J.row(row).transpose();
      }
    }
  }
}

void ElementDerivatives::add_product(const ColumnBlock& p, ColumnBlock& Hp, double* scratch) const {
  if (squared_) {
    add_node_product(p, Hp);
  } else {
    add_element_product(p, Hp, scratch);
  }
}

void ElementDerivatives::add_element_product(const ColumnBlock& p, ColumnBlock& Hp,
                                             double* scratch) const {
  const int d = columns_->dimension(), rows = energy_->rows(), n = width_ / d;
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxResiduals, 1> Jp(rows);
  const int* rank = rank_.data();
  const double* J = J_.data();
  for (int e = 0; e < energy_->size(); ++e, rank += n, J += std::ptrdiff_t(rows) * width_) {
    for (int c = 0; c < n; ++c) {
      for (int i = 0; i < d; ++i) scratch[c * d + i] = rank[c] >= 0 ? p(i, rank[c]) : 0;
    }
    const Eigen::Map<const Eigen::MatrixXd> Je(J, rows, width_);
    Jp.noalias() = weight_ * (Je * Eigen::Map<const Eigen::VectorXd>(scratch, width_));
    for (int c = 0; c < n; ++c) {
      for (int i = 0; i < d && rank[c] >= 0; ++i) Hp(i, rank[c]) += Je.col(c * d + i).dot(Jp);
    }
  }
}

void ElementDerivatives::add_diagonal(Eigen::VectorXd& D) const {
  const int d = columns_->dimension(), n = width_ / d;
  for (std::ptrdiff_t k = 0; k < std::ptrdiff_t(energy_->size()) * n; ++k) {
    for (int i = 0; i < d && rank_[k] >= 0; ++i) {
      D[d * rank_[k] + i] +=
          weight_ * (squared_ ? JtJ_(k % n * d + i, k * d + i) : J_.col(k * d + i).squaredNorm());
    }
  }
}

}  // namespace deformlab
