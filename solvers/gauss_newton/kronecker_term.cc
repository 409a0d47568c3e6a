#include "solvers/gauss_newton/kronecker_term.h"

#include "geometry/core/simd_block.h"
#include "geometry/core/simd_dispatch.h"

namespace deformlab {
namespace {

template <bool derivative>
DEFORMLAB_INLINE double sum(const double* a, const double* b, const int* column, std::ptrdiff_t n,
                            std::ptrdiff_t elements, const double* X, double weight, double* G) {
  SimdBlock E = {};
  for (std::ptrdiff_t e = 0; e < elements; ++e, a += n, b += 4, column += n) {
    SimdBlock r = -simd_block(b);
    for (std::ptrdiff_t c = 0; c < n; ++c)
      r += a[c] * simd_block(X + 4 * std::ptrdiff_t(column[c]));
    E += r * r;
    if (!derivative) continue;
    r *= weight;
    for (std::ptrdiff_t c = 0; c < n; ++c)
      simd_block(G + 4 * std::ptrdiff_t(column[c])) += a[c] * r;
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

double energy(const KroneckerTerm& t, const ColumnBlock& X) {
  return sum_up(t.a.data(), t.b.data(), t.column, t.a.rows(), t.a.cols(), X.data());
}

double energy(const KroneckerTerm& t, const ColumnBlock& X, double weight, ColumnBlock& G) {
  return sum_up(t.a.data(), t.b.data(), t.column, t.a.rows(), t.a.cols(), X.data(), weight,
                G.data());
}

}  // namespace deformlab
