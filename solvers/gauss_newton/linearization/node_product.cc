#include "geometry/core/simd_block.h"
#include "geometry/core/simd_dispatch.h"
#include "solvers/gauss_newton/linearization/element_derivatives.h"

namespace deformlab {
namespace {

// Hp += w JᵀJ p for elements that read one node each, with a dense block JᵀJ for each node. Four
// entries are read from the first entry of a column on. If d < 4, the last ones belong to the next
// column, so they are finally multiplied by 0.
template <int d, int count>
DEFORMLAB_INLINE void multiply(const int* rank, const double* JtJ, std::ptrdiff_t elements,
                               double weight, const double* p, double* Hp) {
  constexpr int n = d * count;
  const SimdBlock own = {weight, weight, d > 2 ? weight : 0, 0};
  for (std::ptrdiff_t e = 0; e < elements; ++e, rank += count, JtJ += n * n) {
    if (rank[0] < 0) continue;
    SimdBlock sum[count] = {};
    const double* column = JtJ;
    for (int q = 0; q < count; ++q) {
      const double* x = p + 4 * std::ptrdiff_t(rank[q]);
      for (int i = 0; i < d; ++i, column += n) {
        for (int c = 0; c < count; ++c) sum[c] += x[i] * simd_block(column + c * d).v;
      }
    }
    for (int c = 0; c < count; ++c) simd_block(Hp + 4 * std::ptrdiff_t(rank[c])).v += own * sum[c];
  }
}

// The sizes of the nodes of graphs in space and in the plane.
DEFORMLAB_SIMD_DISPATCH
void multiply_3_3(const int* rank, const double* JtJ, std::ptrdiff_t elements, double weight,
                  const double* p, double* Hp) {
  multiply<3, 3>(rank, JtJ, elements, weight, p, Hp);
}
DEFORMLAB_SIMD_DISPATCH
void multiply_2_2(const int* rank, const double* JtJ, std::ptrdiff_t elements, double weight,
                  const double* p, double* Hp) {
  multiply<2, 2>(rank, JtJ, elements, weight, p, Hp);
}

void multiply_any(int d, int count, const int* rank, const double* JtJ, std::ptrdiff_t elements,
                  double weight, const double* p, double* Hp) {
  const int n = d * count;
  for (std::ptrdiff_t e = 0; e < elements; ++e, rank += count, JtJ += n * n) {
    if (rank[0] < 0) continue;
    for (int q = 0; q < n; ++q) {
      const double x = weight * p[4 * std::ptrdiff_t(rank[q / d]) + q % d];
      for (int r = 0; r < n; ++r) Hp[4 * std::ptrdiff_t(rank[r / d]) + r % d] += JtJ[q * n + r] * x;
    }
  }
}

}  // namespace

void ElementDerivatives::add_node_product(const ColumnBlock& p, ColumnBlock& Hp) const {
  const int d = columns_->dimension(), count = width_ / d, elements = energy_->size();
  if (d == 3 && count == 3) {
    multiply_3_3(rank_.data(), JtJ_.data(), elements, weight_, p.data(), Hp.data());
  } else if (d == 2 && count == 2) {
    multiply_2_2(rank_.data(), JtJ_.data(), elements, weight_, p.data(), Hp.data());
  } else {
    multiply_any(d, count, rank_.data(), JtJ_.data(), elements, weight_, p.data(), Hp.data());
  }
}

}  // namespace deformlab
