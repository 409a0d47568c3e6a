#include "solvers/separable_term.h"

#include "geometry/clones.h"
#include "geometry/four.h"

namespace deformlab {
namespace {

template <bool derivative>
DEFORMLAB_INLINE double sum(const double* a, const double* b, const int* column, std::ptrdiff_t n,
                            std::ptrdiff_t elements, const double* X, double weight, double* G) {
  Four E = {};
  for (std::ptrdiff_t e = 0; e < elements; ++e, a += n, b += 4, column += n) {
    Four r = -four(b);
    for (std::ptrdiff_t c = 0; c < n; ++c) r += a[c] * four(X + 4 * std::ptrdiff_t(column[c]));
    E += r * r;
    if (!derivative) continue;
    r *= weight;
    for (std::ptrdiff_t c = 0; c < n; ++c) four(G + 4 * std::ptrdiff_t(column[c])) += a[c] * r;
  }
  return (E[0] + E[1]) + (E[2] + E[3]);
}

DEFORMLAB_CLONES
double sum_up(const double* a, const double* b, const int* column, std::ptrdiff_t n,
              std::ptrdiff_t elements, const double* X) {
  return sum<false>(a, b, column, n, elements, X, 0, nullptr);
}

DEFORMLAB_CLONES
double sum_up(const double* a, const double* b, const int* column, std::ptrdiff_t n,
              std::ptrdiff_t elements, const double* X, double weight, double* G) {
  return sum<true>(a, b, column, n, elements, X, weight, G);
}

}  // namespace

double energy(const SeparableTerm& t, const Columns4& X) {
  return sum_up(t.a.data(), t.b.data(), t.column, t.a.rows(), t.a.cols(), X.data());
}

double energy(const SeparableTerm& t, const Columns4& X, double weight, Columns4& G) {
  return sum_up(t.a.data(), t.b.data(), t.column, t.a.rows(), t.a.cols(), X.data(), weight,
                G.data());
}

}  // namespace deformlab
