#include "experiments/measure/depth_options.h"

#include "geometry/plane/overlap/overlap_measure.h"

namespace deformlab {
namespace {

Eigen::VectorXd order_of(DepthFront front, const Triangulation& rest) {
  if (front == DepthFront::kEnds) return distance_from_middle(rest);
  const bool along_x = front == DepthFront::kRight || front == DepthFront::kLeft;
  const double sign = front == DepthFront::kRight || front == DepthFront::kBottom ? 1 : -1;
  return sign * rest.V.row(along_x ? 0 : 1).transpose();
}

// Adds the levels, of which one step exceeds the range of the order.
Eigen::VectorXd leveled(Eigen::VectorXd order, const Eigen::VectorXd& levels) {
  if (levels.size() > 0) order += 2 * (order.maxCoeff() - order.minCoeff()) * levels;
  return order;
}

double area_of(const Triangulation& mesh) {
  double area = 0;
  for (const auto f : mesh.F.colwise()) {
    const Eigen::Vector2d a = mesh.V.col(f[1]) - mesh.V.col(f[0]);
    const Eigen::Vector2d b = mesh.V.col(f[2]) - mesh.V.col(f[0]);
    area += std::abs(a.x() * b.y() - a.y() * b.x()) / 2;
  }
  return area;
}

}  // namespace

DrawingDepth::DrawingDepth(const DepthOptions& options, const Triangulation& rest,
                           const Eigen::VectorXd& levels)
    : options_(options),
      rest_(rest),
      order_(leveled(order_of(options.front, rest), levels)),
      static_(vertex_depths(rest.F, order_).colwise().mean()),
      adjusted_(rest, order_) {}

const Eigen::VectorXd& DrawingDepth::update(const Eigen::Matrix2Xd& V) {
  const Eigen::VectorXd& adjusted = adjusted_.update(V);
  return options_.adjust ? adjusted : static_;
}

Metrics DrawingDepth::metrics(const Eigen::Matrix2Xd& V) const {
  const Overlaps& overlaps = adjusted_.overlaps();
  const Triangulation deformed{V, rest_.F};
  const auto worst = [&](const Eigen::Matrix3Xd& depth) {
    return interpenetration(deformed, overlaps, depth).worst;
  };
  const double at_rest = worst(vertex_depths(rest_.F, order_));
  return {
      {"overlap_area", overlaps.area / area_of(rest_)},
      {"overlap_regions", static_cast<double>(overlaps.regions.size())},
      {"interpenetration_static", at_rest},
      {"interpenetration", options_.adjust ? worst(triangle_depths(adjusted_.depth())) : at_rest}};
}

}  // namespace deformlab
