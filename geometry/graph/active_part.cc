#include "geometry/graph/active_part.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_set>

#include "geometry/core/hash.h"
#include "geometry/graph/placement/loose_vertices.h"

namespace deformlab {
namespace {

constexpr double kCell = 2;  // node spacings

using Mask = std::vector<char>;

bool any_of(const std::vector<int>& face, const Mask& mask) {
  return std::ranges::any_of(face, [&](int i) { return mask[i] != 0; });
}

// The area of the faces that move, and for points without faces the square of their extent.
double moving_area(const Shape& shape, const Mask& free) {
  double area = 0;
  for (const auto& face : shape.faces) {
    if (!any_of(face, free)) continue;
    for (std::size_t c = 1; c + 1 < face.size(); ++c) {
      const Eigen::Vector3d u = shape.V.col(face[c]) - shape.V.col(face[0]);
      const Eigen::Vector3d v = shape.V.col(face[c + 1]) - shape.V.col(face[0]);
      area += u.cross(v).norm() / 2;
    }
  }
  std::vector<int> loose = loose_vertices(shape);
  std::erase_if(loose, [&](int i) { return !free[i]; });
  if (loose.size() < 2) return area;
  return area + std::pow(bounding_box_diagonal(shape.V(Eigen::all, loose)), 2);
}

// Cells of a grid that hold a vertex that is not fixed, with the cells around them.
class Cells {
 public:
  Cells(const Shape& shape, const Mask& free, double size)
      : low_(shape.V.rowwise().minCoeff()), size_(size) {
    Place last{-1, -1, -1};
    for (std::size_t i = 0; i < free.size(); ++i) {
      if (!free[i]) continue;
      const Place at = place(shape.V.col(static_cast<Eigen::Index>(i)));
      if (at != last) mark_around(at);
      last = at;
    }
  }

  bool has(const Eigen::Vector3d& p) const { return cells_.contains(key(place(p))); }

 private:
  using Place = std::array<std::int64_t, 3>;

  Place place(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d at = (p - low_) / size_;
    return {static_cast<std::int64_t>(at[0]), static_cast<std::int64_t>(at[1]),
            static_cast<std::int64_t>(at[2])};
  }
  static std::uint64_t key(const Place& p) {
    std::uint64_t key = 0;
    for (const std::int64_t x : p) key = mixed(key, static_cast<std::uint64_t>(x));
    return key;
  }
  void mark_around(const Place& p) {
    if (!centers_.insert(key(p)).second) return;
    for (int c = 0; c < 27; ++c) {
      cells_.insert(key({p[0] + c % 3 - 1, p[1] + c / 3 % 3 - 1, p[2] + c / 9 - 1}));
    }
  }

  Eigen::Vector3d low_;
  double size_;
  std::unordered_set<std::uint64_t> centers_, cells_;
};

Mask active_vertices(const Shape& shape, const Mask& free, int m) {
  Mask active = free;
  for (const auto& face : shape.faces) {
    if (!any_of(face, free)) continue;
    for (const int i : face) active[i] = 1;
  }
  const double moving = moving_area(shape, free);
  const double area = moving > 0 ? moving : std::pow(bounding_box_diagonal(shape.V), 2);
  const double spacing = std::sqrt(area / m);
  // A cell must not be so small that its number has no room.
  const double cell = std::max(kCell * spacing, 1e-9 * bounding_box_diagonal(shape.V));
  if (!(cell > 0)) return active;
  const Cells cells(shape, free, cell);
  for (std::size_t i = 0; i < active.size(); ++i) {
    if (!active[i]) active[i] = cells.has(shape.V.col(static_cast<Eigen::Index>(i)));
  }
  return active;
}

// The number of each vertex within the part, or −1.
std::vector<int> numbers(const std::vector<int>& vertices, Eigen::Index count) {
  std::vector<int> number(static_cast<std::size_t>(count), -1);
  for (std::size_t i = 0; i < vertices.size(); ++i) number[vertices[i]] = static_cast<int>(i);
  return number;
}

std::vector<int> renumbered(const std::vector<int>& vertices, const std::vector<int>& number) {
  std::vector<int> result;
  for (const int i : vertices) {
    if (number[i] >= 0) result.push_back(number[i]);
  }
  return result;
}

ActivePart part_of(const Shape& shape, const Mask& active) {
  ActivePart part;
  for (std::size_t i = 0; i < active.size(); ++i) {
    if (active[i]) part.vertices.push_back(static_cast<int>(i));
  }
  part.shape.V = shape.V(Eigen::all, part.vertices);
  const std::vector<int> number = numbers(part.vertices, shape.V.cols());
  for (const auto& face : shape.faces) {
    std::vector<int> inside = renumbered(face, number);
    if (inside.size() == face.size()) part.shape.faces.push_back(std::move(inside));
  }
  return part;
}

}  // namespace

ActivePart active_part(const Shape& shape, std::span<const int> fixed, int m) {
  Mask free(static_cast<std::size_t>(shape.V.cols()), 1);
  for (const int i : fixed) free[i] = 0;
  const bool all_fixed = std::ranges::find(free, 1) == free.end();
  return part_of(shape, all_fixed ? Mask(free.size(), 1) : active_vertices(shape, free, m));
}

std::vector<Cut> cuts_of(const ActivePart& part, std::span<const Cut> cuts, Eigen::Index vertices) {
  const std::vector<int> number = numbers(part.vertices, vertices);
  std::vector<Cut> result;
  for (const Cut& cut : cuts) {
    Cut inside{renumbered(cut.a, number), renumbered(cut.b, number), cut.name};
    if (!inside.a.empty() && !inside.b.empty()) result.push_back(std::move(inside));
  }
  return result;
}

Embedding embedding_of_whole(const ActivePart& part, const Embedding& of_part,
                             const Eigen::Matrix3Xd& V) {
  const Eigen::Index k = of_part.nodes.rows(), n = V.cols();
  Embedding whole{V, Eigen::MatrixXi(k, n), Eigen::MatrixXd::Zero(k, n)};
  whole.nodes.colwise() = Eigen::VectorXi::LinSpaced(k, 0, static_cast<int>(k) - 1);
  whole.weights.row(0).setOnes();
  for (std::size_t i = 0; i < part.vertices.size(); ++i) {
    const auto from = static_cast<Eigen::Index>(i);
    whole.nodes.col(part.vertices[i]) = of_part.nodes.col(from);
    whole.weights.col(part.vertices[i]) = of_part.weights.col(from);
  }
  return whole;
}

}  // namespace deformlab
