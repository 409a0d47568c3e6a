#include "solvers/gauss_newton/linearization/kronecker_part.h"

#include <algorithm>
#include <map>

#include "geometry/core/simd_block.h"
#include "geometry/core/simd_dispatch.h"

namespace deformlab {
namespace {

template <bool derivative>
DEFORMLAB_INLINE double sum(const double* a, const double* b, const int* column, std::ptrdiff_t n,
                            std::ptrdiff_t elements, const double* X, double weight, double* G) {
  SimdBlock E = {};
  for (std::ptrdiff_t e = 0; e < elements; ++e, a += n, b += 4, column += n) {
    SimdBlock r = -simd_block(b).v;
    for (std::ptrdiff_t c = 0; c < n; ++c)
      r += a[c] * simd_block(X + 4 * std::ptrdiff_t(column[c])).v;
    E += r * r;
    if (!derivative) continue;
    r *= weight;
    for (std::ptrdiff_t c = 0; c < n; ++c)
      simd_block(G + 4 * std::ptrdiff_t(column[c])).v += a[c] * r;
  }
  return (E[0] + E[1]) + (E[2] + E[3]);
}

DEFORMLAB_SIMD_DISPATCH
double sum_up(const double* a, const double* b, const int* column, std::ptrdiff_t n,
              std::ptrdiff_t elements, const double* X) {
  return sum<false>(a, b, column, n, elements, X, 0, nullptr);
}

DEFORMLAB_SIMD_DISPATCH
double sum_up(const double* a, const double* b, const int* column, std::ptrdiff_t n,
              std::ptrdiff_t elements, const double* X, double weight, double* G) {
  return sum<true>(a, b, column, n, elements, X, weight, G);
}

}  // namespace

KroneckerPart::KroneckerPart(const WeightedEnergy& term, const FreeColumns& columns)
    : energy_(term.energy.get()),
      weight_(term.weight),
      a_(columns_of_element(*energy_), energy_->size()),
      offsets_(columns.dimension(), energy_->size()),
      b_(ColumnBlock::Zero(4, energy_->size())),
      column_(columns_read(*energy_, columns)) {
  energy_->coefficients(a_.data());
}

void KroneckerPart::set_targets() {
  energy_->offsets(offsets_.data());
  b_.topRows(offsets_.rows()) = offsets_;
}

double KroneckerPart::cost(const ColumnBlock& X) const {
  return weight_ * sum_up(a_.data(), b_.data(), column_.data(), a_.rows(), a_.cols(), X.data());
}

double KroneckerPart::cost(const ColumnBlock& X, ColumnBlock& G) const {
  return weight_ * sum_up(a_.data(), b_.data(), column_.data(), a_.rows(), a_.cols(), X.data(),
                          weight_, G.data());
}

bool KroneckerPart::same(int e, const KroneckerPart& other, int f) const {
  const auto n = a_.rows();
  return std::equal(&column_[e * n], &column_[e * n] + n, &other.column_[f * n]) &&
         a_.col(e) == other.a_.col(f);
}

// Between the elements that both sums begin and end with there are few, as a rule.
KroneckerPart::Difference KroneckerPart::difference_to(const KroneckerPart& next) const {
  int first = 0;
  auto end = static_cast<int>(a_.cols()), next_end = static_cast<int>(next.a_.cols());
  while (first < std::min(end, next_end) && same(first, next, first)) ++first;
  while (std::min(end, next_end) > first && same(end - 1, next, next_end - 1)) --end, --next_end;

  std::multimap<double, int> unmatched;  // the old elements by the sum of their coefficients
  for (int e = first; e < end; ++e) unmatched.emplace(a_.col(e).sum(), e);
  Difference difference;
  for (int f = first; f < next_end; ++f) {
    auto [at, last] = unmatched.equal_range(next.a_.col(f).sum());
    while (at != last && !same(at->second, next, f)) ++at;
    if (at == last) {
      difference.added.push_back(f);
    } else {
      unmatched.erase(at);
    }
  }
  for (const auto& [sum, e] : unmatched) difference.removed.push_back(e);
  return difference;
}

std::vector<LowRankChange::Entry> KroneckerPart::free_coefficients(
    int e, const FreeColumns& columns) const {
  std::map<int, double> sum;  // a column that is read twice has one entry
  for (Eigen::Index c = 0; c < a_.rows(); ++c) {
    const int rank = columns.rank(column_[e * a_.rows() + c]);
    if (rank >= 0 && a_(c, e) != 0) sum[rank] += a_(c, e);
  }
  std::vector<LowRankChange::Entry> result;
  for (const auto& [rank, value] : sum) result.push_back({rank, value});
  return result;
}

}  // namespace deformlab
