#include "solvers/gauss_newton/linearization/low_rank_change.h"

#include <algorithm>
#include <utility>

namespace deformlab {
namespace {

bool same(const std::vector<LowRankChange::Entry>& a, const std::vector<LowRankChange::Entry>& b) {
  return std::ranges::equal(
      a, b, [](const auto& x, const auto& y) { return x.rank == y.rank && x.value == y.value; });
}

}  // namespace

void LowRankChange::add(double s, std::vector<Entry> u) {
  const auto opposite =
      std::ranges::find_if(vectors_, [&](const Vector& v) { return v.s == -s && same(v.u, u); });
  if (opposite != vectors_.end()) {
    vectors_.erase(opposite);
  } else {
    vectors_.push_back({s, std::move(u)});
  }
}

int LowRankChange::negative() const {
  return static_cast<int>(std::ranges::count_if(vectors_, [](const Vector& v) { return v.s < 0; }));
}

Eigen::Vector4d product(const std::vector<LowRankChange::Entry>& u, const ColumnBlock& x) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (const auto& [rank, value] : u) sum += value * x.col(rank);
  return sum;
}

void LowRankChange::add_product(const ColumnBlock& x, ColumnBlock& y) const {
  for (const Vector& v : vectors_) {
    const Eigen::Vector4d scaled = v.s * product(v.u, x);
    for (const auto& [rank, value] : v.u) y.col(rank) += value * scaled;
  }
}

SparseMatrix LowRankChange::lower(int n) const {
  SparseMatrix sum(n, n);
  for (const Vector& v : vectors_) {
    std::vector<SparseEntry> entries;
    for (const auto& [row, a] : v.u) {
      for (const auto& [column, b] : v.u) {
        if (row >= column) entries.push_back({row, column, v.s * a * b});
      }
    }
    sum += sparse_matrix(entries, n);
  }
  return sum;
}

}  // namespace deformlab
