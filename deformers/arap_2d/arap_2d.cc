#include "deformers/arap_2d/arap_2d.h"

#include <fmt/format.h>

#include <limits>

#include "deformers/arap_2d/closed_form_steps.h"
#include "deformers/arap_2d/general_steps.h"
#include "deformers/handle_checks.h"
#include "geometry/core/error.h"
#include "geometry/graph/deformation_graph.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

// Because of rounding a point this far outside counts as inside [extent of the shape].
constexpr double kOutside = 1e-9;
constexpr double kAtCorner = 1e-12;  // smaller barycentric coordinates count as 0

std::unique_ptr<TwoStepSolver> two_steps(const Triangulation& rest,
                                         const Eigen::VectorXd& stiffness,
                                         const Arap2dOptions& options) {
  if (options.steps == TwoStepMethod::kGeneralSolver) {
    return inside_option("solver", [&]() -> std::unique_ptr<TwoStepSolver> {
      return std::make_unique<GeneralSteps>(rest, stiffness, options.refinements, options.solver);
    });
  }
  return std::make_unique<ClosedFormSteps>(rest, stiffness, options.refinements);
}

std::unique_ptr<TwoStepSolver> make_steps(const Triangulation& rest, const Eigen::VectorXd& weights,
                                          const Arap2dOptions& options) {
  check_options(options);
  const Eigen::VectorXd stiffness =
      weights.size() > 0 ? weights : Eigen::VectorXd::Ones(rest.F.cols());
  std::unique_ptr<TwoStepSolver> steps = two_steps(rest, stiffness, options);
  return inside_option("elastic", [&]() -> std::unique_ptr<TwoStepSolver> {
    check_elastic(options.elastic);
    if (!options.elastic.is_used()) return std::move(steps);
    return std::make_unique<ElasticSteps>(std::move(steps), rest, stiffness, options.elastic);
  });
}

}  // namespace

Arap2d::Arap2d(const Triangulation& rest, const Eigen::VectorXd& weights,
               const Arap2dOptions& options)
    : rest_(rest), locate_(rest), deformed_(to_shape(rest)) {
  Stopwatch watch(seconds_["registration"]);
  steps_ = make_steps(rest, weights, options);
  steps_->compile({});
}

BarycentricPoint Arap2d::locate_inside(const Eigen::Vector2d& point) const {
  const Located located = locate_(point);
  const double extent = (rest_.V.rowwise().maxCoeff() - rest_.V.rowwise().minCoeff()).norm();
  if (!(located.distance <= kOutside * extent)) {
    throw InputError(fmt::format(
        "the handle at ({:.6g}, {:.6g}) is outside the shape; the nearest point inside is ({:.6g}, "
        "{:.6g})",
        point.x(), point.y(), located.nearest.x(), located.nearest.y()));
  }
  const Eigen::Vector3i f = rest_.F.col(located.triangle);
  const Eigen::Vector3d b = (located.b.array() < kAtCorner).select(0, located.b);
  for (int c = 0; c < 3; ++c) {
    if (b[(c + 1) % 3] == 0 && b[(c + 2) % 3] == 0) return BarycentricPoint::at_vertex(f[c]);
  }
  return {f, b / b.sum()};
}

void Arap2d::compile(const Handles& handles) {
  seconds_["compile"] = 0;
  Stopwatch watch(seconds_["compile"]);
  check_handles(handles, rest_.V.cols());
  refuse_weights(handles);
  std::vector<BarycentricPoint> points;
  for (const auto* vertices : {&handles.fixed, &handles.moved}) {
    for (const int v : *vertices) points.push_back(BarycentricPoint::at_vertex(v));
  }
  for (const auto p : handles.points.colwise()) points.push_back(locate_inside(p.head<2>()));
  steps_->compile(points);
  points_ = std::move(points);
  fixed_ = std::ssize(handles.fixed);
  targets_.resize(2, std::ssize(points_));
  targets_.leftCols(fixed_) = rest_.V(Eigen::all, handles.fixed);
}

void Arap2d::reset() {
  steps_->reset();
  deformed_.V.topRows<2>() = rest_.V;
}

void Arap2d::measure_triangles(Report& report) const {
  report.min_det_R = std::numeric_limits<double>::infinity();
  for (const auto f : rest_.F.colwise()) {
    const double change = signed_area(steps_->positions(), f) / signed_area(rest_.V, f);
    report.min_det_R = std::min(report.min_det_R, change);
    report.inside_out += change < 0;
  }
}

Report Arap2d::update(const Eigen::Matrix3Xd& targets) {
  check_targets(targets, std::ssize(points_) - fixed_);
  targets_.rightCols(targets.cols()) = targets.topRows<2>();
  Report report;
  {
    Stopwatch watch(report.seconds["solve"]);
    steps_->update(targets_);
  }
  report.solve = steps_->summary();
  const Eigen::Matrix2Xd& V = steps_->positions();
  if (!V.allFinite()) {
    report.solve.status = Status::kFailed;
    report.solve.message = "the targets are too far away to compute with";
    return report;
  }
  deformed_.V.topRows<2>() = V;
  report.nodes = static_cast<int>(V.cols());
  measure_triangles(report);
  Eigen::Matrix3Xd reached = targets;
  for (Eigen::Index l = 0; l < targets.cols(); ++l) {
    reached.col(l).head<2>() = points_[fixed_ + l].at(V);
  }
  measure_handles(reached, targets, report);
  report.seconds.insert(seconds_.begin(), seconds_.end());
  report.notes = steps_->notes();
  report.advice.inside_out =
      "move or turn the handles less, or give what lies between them handles that turn as well";
  return report;
}

}  // namespace deformlab
