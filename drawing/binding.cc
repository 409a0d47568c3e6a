#include "drawing/binding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "geometry/plane/cross.h"

namespace deformlab {

Eigen::Vector3d barycentric(const Eigen::Matrix<double, 2, 3>& c, const Eigen::Vector2d& point) {
  const Eigen::Vector2d e1 = c.col(1) - c.col(0), e2 = c.col(2) - c.col(0);
  const Eigen::Vector2d p = point - c.col(0);
  const double area = cross(e1, e2);
  const double b1 = cross(p, e2) / area, b2 = cross(e1, p) / area;
  return {1 - b1 - b2, b1, b2};
}

Eigen::Matrix<double, 2, 3> corners(const Eigen::Matrix2Xd& V, const Eigen::Matrix3Xi& F,
                                    Eigen::Index f) {
  Eigen::Matrix<double, 2, 3> c;
  for (int i = 0; i < 3; ++i) c.col(i) = V.col(F(i, f));
  return c;
}

/// Finds the motions that points outside follow.
class Binding::Blender {
 public:
  Blender(const Triangulation& rest, const Locator& locator, LocalMotions& motions, double crisp)
      : rest_(rest),
        locator_(locator),
        motions_(motions),
        crisp_(crisp < 0 ? motions.edge() / 8 : crisp) {}

  /// The motions with their weights, whose sum is 1.
  const std::map<int, double>& pulls(const Eigen::Vector2d& point, const Located& place) {
    found_.clear();
    const double exact = std::log2(std::max(1.0, place.distance / motions_.edge()));
    level_ = static_cast<int>(exact);
    upper_ = exact - level_;
    add(place, 1);
    double sum = 1;
    const double radius = kBlend * (place.distance - crisp_);
    if (radius > crisp_ / 4) sum += add_neighbours(point, radius);
    for (auto& [motion, weight] : found_) weight /= sum;
    return found_;
  }

 private:
  void add(const Located& place, double weight) {
    for (int c = 0; c < 3; ++c) {
      if (place.b[c] == 0) continue;
      const int vertex = rest_.F(c, place.triangle);
      found_[motions_.number(vertex, level_)] += weight * place.b[c] * (1 - upper_);
      if (upper_ > 0) found_[motions_.number(vertex, level_ + 1)] += weight * place.b[c] * upper_;
    }
  }

  /// Adds the places of the points of a lattice inside a circle. Its pitch is a power of two, so
  /// that the circles of neighbouring points share the points of the lattice.
  double add_neighbours(const Eigen::Vector2d& point, double radius) {
    const int power = static_cast<int>(std::floor(std::log2(radius / kSteps)));
    const double pitch = std::ldexp(1.0, power);
    double sum = 0;
    const auto from = [&](double x) { return static_cast<long>(std::ceil((x - radius) / pitch)); };
    for (long y = from(point.y()); y * pitch < point.y() + radius; ++y)
      for (long x = from(point.x()); x * pitch < point.x() + radius; ++x) {
        const Eigen::Vector2d at(x * pitch, y * pitch);
        const double t = 1 - (at - point).squaredNorm() / (radius * radius);
        if (t <= 0) continue;
        add(place_at({power, x, y}, at), t * t);
        sum += t * t;
      }
    return sum;
  }

  const Located& place_at(const std::array<long, 3>& key, const Eigen::Vector2d& at) {
    const auto known = places_.find(key);
    return known != places_.end() ? known->second
                                  : places_.emplace(key, locator_(at)).first->second;
  }

  static constexpr double kBlend = 0.75;  // radius, as a share of the distance from the mesh
  static constexpr double kSteps = 2.5;   // least radius in pitches of the lattice

  const Triangulation& rest_;
  const Locator& locator_;
  LocalMotions& motions_;
  double crisp_;
  int level_ = 0;  ///< of motions, and the share of the next level
  double upper_ = 0;
  std::map<int, double> found_;
  std::map<std::array<long, 3>, Located> places_;
};

Binding::Binding(const Triangulation& rest, const Locator& locator, const Eigen::Matrix2Xd& points,
                 double crisp)
    : Binding(rest, locator, points, points, crisp) {}

Binding::Binding(const Triangulation& rest, const Locator& locator, const Eigen::Matrix2Xd& points,
                 const Eigen::Matrix2Xd& places, double crisp)
    : corners_(3, points.cols()),
      triangle_(points.cols()),
      b_(3, points.cols()),
      outside_(points.cols()),
      motions_(rest) {
  Blender blender(rest, locator, motions_, crisp);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector2d point = points.col(i);
    const Located place = locator(places.col(i));
    triangle_[i] = place.triangle;
    outside_[i] = place.distance;
    corners_.col(i) = rest.F.col(place.triangle);
    b_.col(i) =
        place.distance > 0 ? place.b : barycentric(corners(rest.V, rest.F, place.triangle), point);
    if (place.distance == 0) continue;
    const std::size_t begin = pulls_.size();
    for (const auto& [motion, weight] : blender.pulls(point, place))
      pulls_.push_back({motion, weight});
    const double far = place.distance / motions_.edge();
    beyond_.push_back({i,
                       {point.x(), point.y()},
                       {place.nearest.x(), place.nearest.y()},
                       begin,
                       pulls_.size(),
                       1 / (1 + far * far)});
  }
}

Eigen::Matrix2Xd Binding::operator()(const Eigen::Matrix2Xd& V) const {
  Eigen::Matrix2Xd points(2, b_.cols());
  for (Eigen::Index i = 0; i < b_.cols(); ++i) points.col(i) = corners(V, corners_, i) * b_.col(i);
  if (beyond_.empty()) return points;
  const std::vector<RigidMotion> motions = motions_(V);
  for (const Outside& bound : beyond_) {
    std::complex<double> moved = 0, off(points(0, bound.point), points(1, bound.point));
    for (std::size_t k = bound.begin; k < bound.end; ++k) {
      const RigidMotion& motion = motions[pulls_[k].motion];
      moved += pulls_[k].weight * motion(bound.rest);
      off -= pulls_[k].weight * motion(bound.nearest);
    }
    moved += bound.adherence * off;
    points.col(bound.point) << moved.real(), moved.imag();
  }
  return points;
}

}  // namespace deformlab
