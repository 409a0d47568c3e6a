#include "experiments/subjects/shape/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/subjects/shape/edit_files.h"
#include "geometry/core/error.h"

namespace deformlab {

void check_exists(int vertex, const Shape& shape, const std::string& where) {
  const int count = static_cast<int>(shape.V.cols());
  if (vertex >= 0 && vertex < count) return;
  throw InputError(
      fmt::format("{}: vertex {} does not exist; the shape has {} vertices, counted from 0", where,
                  vertex, count));
}

namespace {

/// The vertices whose rest position passes a test, in ascending order.
template <class Inside>
std::vector<int> select_if(const Eigen::Matrix3Xd& V, Inside&& inside) {
  std::vector<int> selected;
  for (int i = 0; i < V.cols(); ++i) {
    if (inside(V.col(i))) selected.push_back(i);
  }
  return selected;
}

std::vector<int> listed(std::vector<int> selected, const Shape& shape, const std::string& where) {
  for (const int i : selected) check_exists(i, shape, where);
  std::sort(selected.begin(), selected.end());
  selected.erase(std::unique(selected.begin(), selected.end()), selected.end());
  return selected;
}

/// A distance of which the square may overflow.
double distance(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
  const double result = (p - q).norm();
  return std::isfinite(result) ? result : (p - q).stableNorm();
}

/// Where the squares of distances would overflow, the nearest vertex is the one that is farthest in
/// the direction of q.
int nearest_vertex(const Eigen::Matrix3Xd& V, const Eigen::Vector3d& q) {
  constexpr double kFar = 1e100;  // shapes reach to 1e50
  Eigen::RowVectorXd distances = (V.colwise() - q).colwise().squaredNorm();
  if (q.cwiseAbs().maxCoeff() > kFar) distances = -q.stableNormalized().transpose() * V;
  Eigen::Index closest = 0;
  distances.minCoeff(&closest);
  return static_cast<int>(closest);
}

/// The vertices selected, in ascending order, each once.
std::vector<int> select(const Selection& by, const Shape& shape, const std::string& where) {
  if (by.vertices) return listed(*by.vertices, shape, where);
  if (by.box) {
    return select_if(shape.V, [&](const auto& p) {
      return (p.array() >= by.box->min.array()).all() && (p.array() <= by.box->max.array()).all();
    });
  }
  if (by.sphere) {
    return select_if(shape.V, [&](const auto& p) {
      return distance(p, by.sphere->center) <= by.sphere->radius;
    });
  }
  if (by.nearest) {
    return {nearest_vertex(shape.V, *by.nearest)};
  }
  return select_if(shape.V, [&](const auto&) { return by.all.has_value(); });
}

}  // namespace

std::string text_of(const Eigen::Vector3d& p, int dimension) {
  if (dimension == 2) return fmt::format("[{:.6g}, {:.6g}]", p.x(), p.y());
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", p.x(), p.y(), p.z());
}

void check_only_true(const std::optional<bool>& flag, const char* name, const std::string& where) {
  if (flag && !*flag) {
    throw InputError(fmt::format("{}: '{}' can only be true; leave it out otherwise", where, name));
  }
}

void check_selection(const Selection& select, const std::string& where) {
  check_only_true(select.all, "all", where);
  const int given = select.vertices.has_value() + select.box.has_value() +
                    select.sphere.has_value() + select.nearest.has_value() +
                    select.point.has_value() + select.file.has_value() + select.all.has_value();
  if (given != 1) {
    throw InputError(fmt::format(
        "{}: 'select' needs exactly one of vertices, box, {}, nearest, point, file, all; found {}",
        where, select.dimension == 2 ? "circle" : "sphere", given));
  }
  if (select.box && (select.box->min.array() > select.box->max.array()).any()) {
    throw InputError(fmt::format("{}: the box's min {} must not exceed its max {}", where,
                                 text_of(select.box->min, select.dimension),
                                 text_of(select.box->max, select.dimension)));
  }
}

void read_selection_file(Selection& select, const ConfigNode& node, const std::string& where) {
  if (!select.file) return;
  select.vertices = read_indices(node.find("file")->folder() / *select.file, where);
  select.file.reset();
}

std::vector<int> select_vertices(const Selection& selection, const Shape& shape,
                                 const std::string& where) {
  if (selection.point) {
    throw InputError(fmt::format(
        "{}: 'point' is a position and need not be a vertex; take 'nearest' here", where));
  }
  std::vector<int> selected = select(selection, shape, where);
  if (!selected.empty()) return selected;
  throw InputError(
      fmt::format("{} selects no vertex; the shape reaches from {} to {}: check the unit and the "
                  "axes of the selection",
                  where, text_of(shape.V.rowwise().minCoeff(), selection.dimension),
                  text_of(shape.V.rowwise().maxCoeff(), selection.dimension)));
}

}  // namespace deformlab
