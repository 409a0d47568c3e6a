#include "deformers/arap_2d/component_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <complex>

namespace deformlab {
namespace {

constexpr double kSamePosition = 1e-9;  // a smaller distance counts as 0 [extent]
constexpr int kMostNamed = 5;           // further components are only counted

}  // namespace

ComponentMotion motion_of(bool has_handles, bool handles_are_distinct) {
  if (!has_handles) return ComponentMotion::kNone;
  return handles_are_distinct ? ComponentMotion::kDeformation : ComponentMotion::kTranslation;
}

Eigen::VectorXcd all_to_complex(const Eigen::Matrix2Xd& V) {
  Eigen::VectorXcd z(V.cols());
  z.real() = V.row(0);
  z.imag() = V.row(1);
  return z;
}

double extent_of(const Eigen::VectorXcd& p) { return (p.array() - p[0]).abs().maxCoeff(); }

bool are_distinct(const std::vector<BarycentricPoint>& points, const Eigen::VectorXcd& p,
                  double extent) {
  return std::any_of(points.begin(), points.end(), [&](const BarycentricPoint& point) {
    return std::abs(point(p) - points[0](p)) > kSamePosition * extent;
  });
}

void MotionNotes::add(const MeshComponent& component, ComponentMotion motion) {
  if (motion == ComponentMotion::kDeformation) return;
  if (std::ssize(named_) == kMostNamed) {
    ++others_;
    return;
  }
  named_.push_back(fmt::format("a part of the mesh ({} vertices, the first is vertex {}) {}",
                               component.vertices.size(), component.vertices.front(),
                               motion == ComponentMotion::kNone
                                   ? "has no handle: it stays where it is"
                                   : "has handles at one point only: it moves there without "
                                     "turning"));
}

std::vector<std::string> MotionNotes::notes() const {
  std::vector<std::string> result = named_;
  if (others_ > 0) {
    result.push_back(fmt::format(
        "parts of the mesh with handles at fewer than two points, besides these: {}", others_));
  }
  return result;
}

}  // namespace deformlab
