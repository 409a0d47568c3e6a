#pragma once

#include <cstddef>

namespace deformlab {

/// A 4×4 matrix M of a node, column by column, with a last row of zeros. No column lies across two
/// lines of the cache.
struct alignas(64) Columns {
  double numbers[16] = {};
};

/// Sums over k nodes for each of n vertices: Σ_j w_j M_j (v, 1), or Σ_j w_j M_j (v, 0).
struct Blend {
  const Columns* M;
  const int* nodes;       ///< k×n
  const double* weights;  ///< k×n
  std::ptrdiff_t k;
  const double* v;  ///< 3×n
  std::ptrdiff_t n;
};

/// Σ_j w_j M_j (v, 1) of the vertices from begin to end, 3×n in all.
void blend_points(const Blend& b, std::ptrdiff_t begin, std::ptrdiff_t end, double* result);

/// Σ_j w_j M_j (v, 0), made unit; one that vanishes stays v.
void blend_directions(const Blend& b, std::ptrdiff_t begin, std::ptrdiff_t end, double* result);

}  // namespace deformlab
