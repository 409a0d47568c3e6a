#include "deformers/handle_checks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

void check_vertices(const std::vector<int>& indices, Eigen::Index count) {
  for (const int i : indices) {
    if (i >= 0 && i < count) continue;
    throw InputError("handle at vertex " + std::to_string(i) +
                     "; the shape has the vertices 0 to " + std::to_string(count - 1));
  }
}

void check_once(std::vector<int> fixed, std::vector<int> moved) {
  std::sort(fixed.begin(), fixed.end());
  std::sort(moved.begin(), moved.end());
  std::vector<int> both;
  std::set_intersection(fixed.begin(), fixed.end(), moved.begin(), moved.end(),
                        std::back_inserter(both));
  if (!both.empty()) {
    throw InputError("vertex " + std::to_string(both.front()) +
                     " is both fixed and moved; leave it out of one");
  }
  const auto twice = std::adjacent_find(moved.begin(), moved.end());
  if (twice == moved.end()) return;
  throw InputError("vertex " + std::to_string(*twice) + " is moved twice; name it once");
}

void check_finite(const Eigen::Matrix3Xd& columns, const std::string& what) {
  for (Eigen::Index l = 0; l < columns.cols(); ++l) {
    if (columns.col(l).allFinite()) continue;
    std::ostringstream message;
    message << what << " " << l << " (counted from 0) is (" << columns.col(l).transpose()
            << "), which is not finite";
    throw InputError(message.str());
  }
}

}  // namespace

void check_handles(const Handles& handles, Eigen::Index vertices) {
  check_vertices(handles.fixed, vertices);
  check_vertices(handles.moved, vertices);
  check_once(handles.fixed, handles.moved);
  check_finite(handles.points, "handle point");
}

void check_targets(const Eigen::Matrix3Xd& targets, Eigen::Index count) {
  if (targets.cols() != count) {
    throw InputError(std::to_string(targets.cols()) + " targets for " + std::to_string(count) +
                     " handles; one for each is needed");
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
