#pragma once

#include <cstddef>

namespace deformlab {

/// The 4×4 matrix M of a node, stored by columns, with a last row of zeros. The alignment keeps
/// each column within one cache line.
struct alignas(64) Columns {
  double numbers[16] = {};
};

/// The input of sums over k nodes for each of n vertices: Σ_j w_j M_j (v, 1), or Σ_j w_j M_j (v,
/// 0).
struct Blend {
  const Columns* M;
  const int* nodes;       ///< k×n
  const double* weights;  ///< k×n
  std::ptrdiff_t k;
  const double* v;  ///< 3×n
  std::ptrdiff_t n;
};

/// Writes Σ_j w_j M_j (v, 1) for the vertices from begin to end − 1 into `result` (3×n).
void blend_points(const Blend& b, std::ptrdiff_t begin, std::ptrdiff_t end, double* result);

/// Writes Σ_j w_j M_j (v, 0), scaled to length one. A sum that vanishes is replaced by v.
void blend_directions(const Blend& b, std::ptrdiff_t begin, std::ptrdiff_t end, double* result);

}  // namespace deformlab
