#include "geometry/graph/placement/graph_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "geometry/graph/deformation_graph.h"
#include "geometry/graph/graph_vertices.h"

namespace deformlab {
namespace {

constexpr double kLongestCell = 2;  // length over width

struct Cells {
  int a, b;      // their numbers along the longest side of the box and along the next
  double shape;  // length over width of a cell, at least 1
};

// The factors a·b = m that make the cells of a w×h rectangle most square.
Cells divide(double w, double h, int m) {
  Cells best{m, 1, HUGE_VAL};
  for (int b = 1; b <= m / b; ++b) {
    if (m % b != 0) continue;
    for (const auto& [along, across] : {std::pair(m / b, b), std::pair(b, m / b)}) {
      const double ratio = (w / along) / (h / across);
      const double shape = std::max(ratio, 1 / ratio);
      if (shape < best.shape) best = {along, across, shape};
    }
  }
  return best;
}

std::string text_of(const Cells& cells) {
  return fmt::format("{} ({} × {})", cells.a * cells.b, cells.a, cells.b);
}

// The next counts below and above m that make good cells: "198 (18 × 11) or 209 (19 × 11)". Empty
// where even a single row of good cells has more cells than the shape has vertices.
std::string next_counts(double w, double h, int m, Eigen::Index most) {
  std::string text;
  for (const int step : {-1, 1}) {
    for (int count = m + step; count > 0 && count <= most; count += step) {
      const Cells cells = divide(w, h, count);
      if (cells.shape > kLongestCell) continue;
      text += (text.empty() ? "" : " or ") + text_of(cells);
      break;
    }
  }
  return text;
}

Cells checked_cells(double w, double h, int m, Eigen::Index vertices) {
  check_number("nodes", m, kNodeRange);
  if (!(h > 0)) {
    throw OptionError("method", "grid", ", which needs a flat shape, but this one is a line");
  }
  const Cells cells = divide(w, h, m);
  if (cells.shape <= kLongestCell) return cells;
  const bool too_thin = w / h / static_cast<double>(vertices) > kLongestCell;
  const std::string counts = too_thin ? "" : next_counts(w, h, m, vertices);
  throw OptionError(
      "nodes", std::to_string(m),
      fmt::format(", which makes no regular grid over a shape of {:.6g} by {:.6g} (at best {} × "
                  "{}); take {}",
                  w, h, cells.a, cells.b, counts.empty() ? "method: sampling" : counts));
}

[[noreturn]] void reject_finer(int m, Eigen::Index vertices, const std::string& why) {
  throw OptionError(
      "nodes", std::to_string(m),
      fmt::format(", a grid finer than the shape's {} vertices{}; use fewer nodes", vertices, why));
}

// The axes in the order of the sides of the bounding box, the longest first.
std::array<int, 3> by_extent(const Eigen::Vector3d& extent) {
  std::array<int, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int r, int s) { return extent[r] > extent[s]; });
  return axes;
}

}  // namespace

std::vector<int> grid_nodes(const Shape& shape, int m) {
  if (m > shape.V.cols()) reject_finer(m, shape.V.cols(), "");
  const Eigen::Vector3d low = shape.V.rowwise().minCoeff();
  const Eigen::Vector3d extent = shape.V.rowwise().maxCoeff() - low;
  const auto [u, v, off] = by_extent(extent);
  const Cells cells = checked_cells(extent[u], extent[v], m, shape.V.cols());
  Eigen::Matrix3Xd flat = shape.V, middles = Eigen::Matrix3Xd::Zero(3, m);
  flat.row(off).setZero();
  for (int j = 0; j < m; ++j) {
    middles(u, j) = low[u] + (j % cells.a + 0.5) / cells.a * extent[u];
    middles(v, j) = low[v] + (static_cast<int>(j / cells.a) + 0.5) / cells.b * extent[v];
  }
  std::vector<int> nodes = nearest_vertices(middles, flat);
  std::vector<int> sorted = nodes;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice == sorted.end()) return nodes;
  reject_finer(m, shape.V.cols(),
               fmt::format(": vertex {} is nearest to two of its cells", *twice));
}

}  // namespace deformlab
