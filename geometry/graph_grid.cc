#include "geometry/graph_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>

#include "geometry/error.h"
#include "geometry/graph_vertices.h"

namespace deformlab {
namespace {

constexpr double kLongestCell = 2;  // times its width

struct Cells {
  int a, b;      // along the longest side of the box, and the next
  double shape;  // length over width of a cell, at least 1
};

// m as the product a·b that makes the cells of a w×h rectangle most square.
Cells divide(double w, double h, int m) {
  Cells best{m, 1, HUGE_VAL};
  for (int b = 1; b <= m; ++b) {
    if (m % b != 0) continue;
    const int a = m / b;
    const double ratio = (w / a) / (h / b);
    const double shape = std::max(ratio, 1 / ratio);
    if (shape < best.shape) best = {a, b, shape};
  }
  return best;
}

// "198 (18 × 11)" for the next count in that direction which makes good cells.
std::string next_count(double w, double h, int m, int step) {
  for (int count = m + step; count > 0; count += step) {
    const Cells cells = divide(w, h, count);
    if (cells.shape > kLongestCell) continue;
    return std::to_string(count) + " (" + std::to_string(cells.a) + " × " +
           std::to_string(cells.b) + ")";
  }
  return "";
}

Cells checked_cells(double w, double h, int m) {
  if (m < 1) throw InputError("graph.nodes is " + std::to_string(m) + "; at least 1 is needed");
  if (!(h > 0)) throw InputError("graph.method: grid needs a flat shape, but this one is a line");
  const Cells cells = divide(w, h, m);
  if (cells.shape <= kLongestCell) return cells;
  std::ostringstream message;
  message << "graph.nodes is " << m << ", which makes no regular grid over a shape of " << w
          << " by " << h << " (at best " << cells.a << " × " << cells.b << "); take ";
  const std::string fewer = next_count(w, h, m, -1);
  if (!fewer.empty()) message << fewer << " or ";
  message << next_count(w, h, m, 1);
  throw InputError(message.str());
}

// The rows of V: the longest side of the bounding box first, then the next.
std::array<int, 3> by_extent(const Eigen::Vector3d& extent) {
  std::array<int, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int r, int s) { return extent[r] > extent[s]; });
  return axes;
}

}  // namespace

std::vector<int> grid_nodes(const Shape& shape, int m) {
  const Eigen::Vector3d low = shape.V.rowwise().minCoeff();
  const Eigen::Vector3d extent = shape.V.rowwise().maxCoeff() - low;
  const auto [u, v, off] = by_extent(extent);
  const Cells cells = checked_cells(extent[u], extent[v], m);
  Eigen::Matrix3Xd flat = shape.V, middles = Eigen::Matrix3Xd::Zero(3, m);
  flat.row(off).setZero();
  for (int j = 0; j < m; ++j) {
    middles(u, j) = low[u] + (j % cells.a + 0.5) / cells.a * extent[u];
    middles(v, j) = low[v] + (static_cast<int>(j / cells.a) + 0.5) / cells.b * extent[v];
  }
  const std::vector<int> nodes = nearest_vertices(middles, flat);
  std::vector<int> sorted = nodes;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice == sorted.end()) return nodes;
  throw InputError("graph.nodes is " + std::to_string(m) + ", a grid finer than the shape's " +
                   std::to_string(shape.V.cols()) + " vertices: vertex " + std::to_string(*twice) +
                   " is nearest to two of its cells; use fewer nodes");
}

}  // namespace deformlab
