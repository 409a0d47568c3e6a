#include "experiments/measure/stripes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "geometry/core/options.h"

namespace deformlab {
namespace {

Eigen::VectorXd slopes(const Eigen::Matrix3Xd& V, int columns) {
  const Eigen::Index rows = V.cols() / columns;
  Eigen::VectorXd result = Eigen::VectorXd::Zero(columns - 1);
  for (Eigen::Index j = 0; j < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const Eigen::Vector3d step = V.col(j * columns + i + 1) - V.col(j * columns + i);
      result[i] += std::atan2(step.z(), step.x()) * 180 / std::numbers::pi;
    }
  }
  return result / static_cast<double>(rows);
}

}  // namespace

Metrics stripes(const Eigen::Matrix3Xd& V, int columns, int window) {
  if (window < 3 || window % 2 == 0 || window >= columns) {
    throw OptionError("measure.stripes", std::to_string(window),
                      fmt::format("; allowed: an odd number of columns, 3 to {}", columns - 1));
  }
  const Eigen::VectorXd slope = slopes(V, columns);
  const Eigen::Index count = slope.size() - window + 1;
  double sum = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double rest = slope[i + window / 2] - slope.segment(i, window).mean();
    sum += rest * rest;
  }
  return {{"stripes", std::sqrt(sum / static_cast<double>(count))}};
}

}  // namespace deformlab
