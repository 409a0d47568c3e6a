#include "deformers/handle_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

void check_vertices(const std::vector<int>& indices, Eigen::Index count) {
  for (const int i : indices) {
    if (i >= 0 && i < count) continue;
    throw InputError(
        fmt::format("handle at vertex {}; the shape has the vertices 0 to {}", i, count - 1));
  }
}

void check_once(std::vector<int> fixed, std::vector<int> moved) {
  std::sort(fixed.begin(), fixed.end());
  std::sort(moved.begin(), moved.end());
  std::vector<int> both;
  std::set_intersection(fixed.begin(), fixed.end(), moved.begin(), moved.end(),
                        std::back_inserter(both));
  if (!both.empty()) {
    throw InputError(
        fmt::format("vertex {} is both fixed and moved; leave it out of one", both.front()));
  }
  const auto twice = std::adjacent_find(moved.begin(), moved.end());
  if (twice == moved.end()) return;
  throw InputError(fmt::format("vertex {} is moved twice; name it once", *twice));
}

void check_finite(const Eigen::Matrix3Xd& columns, const char* what) {
  for (Eigen::Index l = 0; l < columns.cols(); ++l) {
    if (columns.col(l).allFinite()) continue;
    throw InputError(
        fmt::format("{} {} (counted from 0) is ({:.6g}, {:.6g}, {:.6g}), which is not finite", what,
                    l, columns(0, l), columns(1, l), columns(2, l)));
  }
}

// Throws unless there is one of `what` for each handle, or none.
void check_count(Eigen::Index given, const char* what, const Handles& handles) {
  if (given == 0 || given == handles.targets()) return;
  throw InputError(fmt::format("{} {} for {} handles; give one for each, or none", given, what,
                               handles.targets()));
}

void check_motions(const Handles& handles) {
  check_count(std::ssize(handles.groups), "groups", handles);
  check_count(handles.rotations.cols(), "rotations", handles);
  check_count(handles.weights.size(), "weights", handles);
  for (Eigen::Index l = 0; l < handles.weights.size(); ++l) {
    if (handles.weights[l] > 0 && std::isfinite(handles.weights[l])) continue;
    throw InputError(fmt::format(
        "weight {} (counted from 0) of a handle is {:.6g}; it must be a finite number above 0", l,
        handles.weights[l]));
  }
  for (Eigen::Index l = 0; l < handles.rotations.cols(); ++l) {
    const Eigen::Vector3d turn = handles.rotations.col(l);
    if (turn.allFinite() || turn.array().isNaN().all()) continue;
    throw InputError(fmt::format(
        "rotation {} (counted from 0) is ({:.6g}, {:.6g}, {:.6g}); it needs three finite numbers, "
        "or three NaN where nothing is said about it",
        l, turn.x(), turn.y(), turn.z()));
  }
}

}  // namespace

void check_handles(const Handles& handles, Eigen::Index vertices) {
  check_vertices(handles.fixed, vertices);
  check_vertices(handles.moved, vertices);
  check_once(handles.fixed, handles.moved);
  check_finite(handles.points, "handle point");
  check_motions(handles);
}

void refuse_weights(const Handles& handles) {
  if (handles.weights.size() == 0) return;
  throw InputError(
      "the edit gives a 'weight' to handles, but this method holds every handle exactly; leave "
      "'weight' out, or use deformer=embedded_deformation");
}

void check_targets(const Eigen::Matrix3Xd& targets, Eigen::Index count) {
  if (targets.cols() != count) {
    throw InputError(
        fmt::format("{} targets for {} handles; one for each is needed", targets.cols(), count));
  }
  check_finite(targets, "target");
}

void measure_handles(const Eigen::Matrix3Xd& reached, const Eigen::Matrix3Xd& targets,
                     Report& report) {
  if (targets.cols() == 0) return;
  const Eigen::VectorXd distance = (reached - targets).colwise().norm();
  report.handle_rms = std::sqrt(distance.squaredNorm() / static_cast<double>(targets.cols()));
  report.handle_max = distance.maxCoeff();
}

}  // namespace deformlab
