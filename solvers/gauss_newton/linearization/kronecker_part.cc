#include "solvers/gauss_newton/linearization/kronecker_part.h"

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

}  // namespace deformlab
