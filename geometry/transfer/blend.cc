#include "geometry/transfer/blend.h"

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "geometry/core/simd_block.h"
#include "geometry/core/simd_dispatch.h"

namespace deformlab {
namespace {

// A blend whose k is the usual one, known at compile time.
struct UsualBlend : Blend {
  static constexpr std::ptrdiff_t k = 4;
};

template <class Action>
DEFORMLAB_INLINE void with_usual(const Blend& b, const Action& action) {
  if (b.k == UsualBlend::k) {
    action(UsualBlend{b});
  } else {
    action(b);
  }
}

constexpr std::ptrdiff_t kAhead = 32;  // vertices that are blended while a matrix is fetched

// Fetches the matrix of the farthest node of a later vertex. A node that comes into use is first
// the farthest node of a vertex.
DEFORMLAB_INLINE void look_ahead(const auto& b, std::ptrdiff_t i) {
  const std::ptrdiff_t later = std::min(i + kAhead, b.n - 1);
  __builtin_prefetch(&b.M[b.nodes[b.k * (later + 1) - 1]]);
}

// Adds w M (v, 1) to the sum, or w M (v, 0) where `columns` is 3.
template <int columns>
DEFORMLAB_INLINE void add(const Columns& M, double w, const double* v, SimdBlock& sum) {
  const double* m = M.numbers;
  SimdBlock there = columns == 4 ? simd_block(m + 12).v : SimdBlock{};
  there += v[0] * simd_block(m).v;
  there += v[1] * simd_block(m + 4).v;
  there += v[2] * simd_block(m + 8).v;
  sum += w * there;
}

// Loads take most of the time. One load therefore reads the indices of two nodes.
template <int columns>
DEFORMLAB_INLINE void blend(const auto& b, std::ptrdiff_t i, SimdBlock& sum) {
  look_ahead(b, i);
  constexpr bool low_first = std::endian::native == std::endian::little;
  const double* v = b.v + 3 * i;
  const int* nodes = b.nodes + b.k * i;
  const double* weights = b.weights + b.k * i;
  sum = SimdBlock{};
  std::ptrdiff_t a = 0;
  for (; a + 1 < b.k; a += 2) {
    std::uint64_t two;
    std::memcpy(&two, nodes + a, sizeof two);
    const std::uint64_t low = two & 0xffffffff, high = two >> 32;
    add<columns>(b.M[low_first ? low : high], weights[a], v, sum);
    add<columns>(b.M[low_first ? high : low], weights[a + 1], v, sum);
  }
  if (a < b.k) add<columns>(b.M[nodes[a]], weights[a], v, sum);
}

DEFORMLAB_INLINE void store(const SimdBlock& sum, double* p) {
  p[0] = sum[0], p[1] = sum[1], p[2] = sum[2];
}

DEFORMLAB_INLINE void points(const auto& b, std::ptrdiff_t begin, std::ptrdiff_t end,
                             double* result) {
  for (std::ptrdiff_t i = begin; i < end; ++i) {
    SimdBlock sum;
    blend<4>(b, i, sum);
    store(sum, result + 3 * i);
  }
}

// Four directions before they are normalised, and their squared lengths.
struct Raw {
  SimdBlock sums[4];
  SimdBlock squares;
};

// The squared lengths of four vectors.
DEFORMLAB_INLINE void square(const SimdBlock& p, const SimdBlock& q, const SimdBlock& r,
                             const SimdBlock& s, SimdBlock& squares) {
  const SimdBlock pq_xz = __builtin_shufflevector(p, q, 0, 4, 2, 6);
  const SimdBlock rs_xz = __builtin_shufflevector(r, s, 0, 4, 2, 6);
  const SimdBlock pq_y = __builtin_shufflevector(p, q, 1, 5, 3, 7);
  const SimdBlock rs_y = __builtin_shufflevector(r, s, 1, 5, 3, 7);
  const SimdBlock x = __builtin_shufflevector(pq_xz, rs_xz, 0, 1, 4, 5);
  const SimdBlock y = __builtin_shufflevector(pq_y, rs_y, 0, 1, 4, 5);
  const SimdBlock z = __builtin_shufflevector(pq_xz, rs_xz, 2, 3, 6, 7);
  squares = x * x + y * y + z * z;
}

// Blends `count` ≤ 4 vertices from i on; the last of them fills the rest of the four.
DEFORMLAB_INLINE void blend_four(const auto& b, std::ptrdiff_t i, int count, Raw& raw) {
  SimdBlock p, q, r, s;  // variables instead of an array, so that they stay in registers
  blend<3>(b, i, p);
  blend<3>(b, i + std::min(1, count - 1), q);
  blend<3>(b, i + std::min(2, count - 1), r);
  blend<3>(b, i + count - 1, s);
  raw.sums[0] = p, raw.sums[1] = q, raw.sums[2] = r, raw.sums[3] = s;
  square(p, q, r, s, raw.squares);
}

DEFORMLAB_INLINE void store_unit(const auto& b, std::ptrdiff_t i, int count, const Raw& raw,
                                 double* result) {
  Eigen::Array4d scale;
  simd_block(scale.data()).v = raw.squares;
  scale = scale.sqrt().inverse();
  for (int l = 0; l < count; ++l) {
    const double* v = b.v + 3 * (i + l);
    const bool vanishes = !(scale[l] < std::numeric_limits<double>::infinity());
    store(vanishes ? SimdBlock{v[0], v[1], v[2], 0} : raw.sums[l] * scale[l], result + 3 * (i + l));
  }
}

// Computes roots and quotients of four directions at once while the next four are blended.
DEFORMLAB_INLINE void directions(const auto& b, std::ptrdiff_t begin, std::ptrdiff_t end,
                                 double* result) {
  const std::ptrdiff_t full = begin + (end - begin) / 4 * 4;
  if (full > begin) {
    Raw raw, last;
    blend_four(b, begin, 4, last);
    for (std::ptrdiff_t i = begin + 4; i < full; i += 4) {
      blend_four(b, i, 4, raw);
      store_unit(b, i - 4, 4, last, result);
      last = raw;
    }
    store_unit(b, full - 4, 4, last, result);
  }
  if (full == end) return;
  Raw rest;
  blend_four(b, full, static_cast<int>(end - full), rest);
  store_unit(b, full, static_cast<int>(end - full), rest, result);
}

}  // namespace

DEFORMLAB_SIMD_DISPATCH
void blend_points(const Blend& blend, std::ptrdiff_t begin, std::ptrdiff_t end, double* result) {
  with_usual(blend, [&](const auto& b) DEFORMLAB_INLINED { points(b, begin, end, result); });
}

DEFORMLAB_SIMD_DISPATCH
void blend_directions(const Blend& blend, std::ptrdiff_t begin, std::ptrdiff_t end,
                      double* result) {
  with_usual(blend, [&](const auto& b) DEFORMLAB_INLINED { directions(b, begin, end, result); });
}

}  // namespace deformlab
