#include "experiments/subjects/drawing/plane_shortfalls.h"

#include <fmt/format.h>

#include "drawing/binding.h"
#include "experiments/measure/drag.h"
#include "experiments/measure/shortfalls.h"
#include "geometry/plane/locator.h"

namespace deformlab {
namespace {

// The positions of the handles that have targets, 2×p, with the vertices at V.
Eigen::Matrix2Xd places_of(const DrawingScene& scene, const Handles& handles,
                           const Eigen::Matrix2Xd& V) {
  const auto moved = std::ssize(handles.moved);
  Eigen::Matrix2Xd places(2, moved + handles.points.cols());
  places.leftCols(moved) = V(Eigen::all, handles.moved);
  const Eigen::Matrix2Xd points = handles.points.topRows<2>();
  places.rightCols(points.cols()) = Binding(scene.rest, Locator(scene.rest), points)(V);
  return places;
}

// What helps; a flat mesh that is read from a file keeps its vertices.
std::string advice(const DrawingScene& scene, const Report& report) {
  std::string text = "move handles that are near to each other alike, take one of them away";
  if (!scene.drawing.mesh)
    text += fmt::format(", set a greater drawing.vertices (the mesh has {})", scene.rest.V.cols());
  return fmt::format("{}, or {}", text, report.advice.missed);
}

// The triangles that are turned inside out.
struct Flipped {
  int count = 0;
  double area = 0, all = 0;  // at rest, theirs and that of all triangles
  double largest = 0;        // area at rest
  Eigen::Vector2d at;        // the centre of the largest one at rest
};

Flipped flipped(const Triangulation& rest, const Eigen::Matrix2Xd& V) {
  Flipped found;
  for (Eigen::Index f = 0; f < rest.F.cols(); ++f) {
    const Eigen::Vector3i t = rest.F.col(f);
    const double area = signed_area(rest.V, t);
    found.all += std::abs(area);
    if (!(area * signed_area(V, t) < 0)) continue;
    ++found.count;
    found.area += std::abs(area);
    if (std::abs(area) <= found.largest) continue;
    found.largest = std::abs(area);
    found.at = rest.V(Eigen::all, t).rowwise().mean();
  }
  return found;
}

}  // namespace

std::vector<std::string> missed_handles(const DrawingScene& scene, const Eigen::Matrix2Xd& V,
                                        const ResolvedEdit& edit, const Report& report) {
  if (edit.targets.cols() == 0) return {};
  const Shape shape = to_shape(scene.rest);
  const Eigen::Matrix2Xd rest = targets_at_rest(shape, edit.handles).topRows<2>();
  const Eigen::Matrix2Xd targets = edit.targets.topRows<2>();
  const Eigen::RowVectorXd misses = (places_of(scene, edit.handles, V) - targets).colwise().norm();
  const double motion = (targets - rest).colwise().norm().maxCoeff();
  const double allowed = allowed_miss(motion, bounding_box_diagonal(shape.V));
  Eigen::Index worst = 0;
  const double most = misses.maxCoeff(&worst);
  if (!(most > allowed)) return {};
  const auto count = (misses.array() > allowed).count();
  const std::string others =
      count > 1 ? fmt::format(" ({} handles stop more than 2 % short)", count) : "";
  return {
      fmt::format("the handle at ({:.6g}, {:.6g}) stops {:.3g} short of its target ({:.6g}, "
                  "{:.6g}), while the edit's longest way is {:.3g}{}; {}",
                  rest(0, worst), rest(1, worst), most, targets(0, worst), targets(1, worst),
                  motion, others, advice(scene, report))};
}

std::vector<std::string> inside_out(const DrawingScene& scene, const Eigen::Matrix2Xd& V,
                                    const Report& report) {
  constexpr double kNoticed = 0.006;  // of the drawing's area
  const Flipped found = flipped(scene.rest, V);
  if (found.count < 2 || !(found.area > kNoticed * found.all)) return {};
  return {fmt::format(
      "{:.2g} % of the drawing is turned inside out, {} of {} triangles, such as the one at "
      "({:.4g}, {:.4g}); {}",
      100 * found.area / found.all, found.count, scene.rest.F.cols(), found.at.x(), found.at.y(),
      report.advice.inside_out)};
}

}  // namespace deformlab
