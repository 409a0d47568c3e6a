#include "experiments/subjects/motion/spatial_keys.h"

#include <Eigen/SVD>
#include <cmath>

namespace deformlab {
namespace {

constexpr int kAngle = kTurnOfNumbers + 2;  // about the axis z
constexpr double kFlat = 1e-9;              // a singular value relative to the first
constexpr double kCancelled = 1e-9;         // the length of a mean of unit vectors

// The directions along which the points, 2×n about their centroid, differ.
Eigen::Matrix2Xd axes_of(const Eigen::Matrix2Xd& points) {
  const Eigen::JacobiSVD<Eigen::Matrix2Xd> svd(points, Eigen::ComputeFullU);
  const auto& s = svd.singularValues();
  const bool flat = s.size() < 2 || s[1] <= kFlat * s[0];
  return svd.matrixU().leftCols(flat ? 1 : 2);
}

double blended_angle(const std::vector<PoseNumbers>& poses, const Eigen::VectorXd& weights) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double angle = poses[i][kAngle];
    sum +=
        weights[static_cast<Eigen::Index>(i)] * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  if (sum.norm() > kCancelled) return std::atan2(sum.y(), sum.x());
  Eigen::Index greatest = 0;
  weights.maxCoeff(&greatest);
  return poses[static_cast<std::size_t>(greatest)][kAngle];
}

}  // namespace

SpatialKeys::SpatialKeys(const Eigen::Matrix2Xd& points)
    : centroid_(points.rowwise().mean()),
      extent_((points.colwise() - centroid_).colwise().norm().maxCoeff()) {
  points_ = (points.colwise() - centroid_) / extent_;
  axes_ = axes_of(points_);
  const Eigen::Index n = points.cols(), size = n + 1 + axes_.cols();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index i = 0; i < n; ++i) {
    A.col(i) = terms(points.col(i));
    A.row(i).tail(size - n) = A.col(i).tail(size - n).transpose();
  }
  system_.compute(A);
}

// The kernel to each point, and the affine part.
Eigen::VectorXd SpatialKeys::terms(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d at = (place - centroid_) / extent_;
  const Eigen::Index n = points_.cols();
  Eigen::VectorXd result(n + 1 + axes_.cols());
  result << (points_.colwise() - at).colwise().norm().transpose(), 1, axes_.transpose() * at;
  return result;
}

Eigen::VectorXd SpatialKeys::weights(const Eigen::Vector2d& place) const {
  return system_.solve(terms(place)).head(points_.cols());
}

PoseNumbers blended(const std::vector<PoseNumbers>& poses, const Eigen::VectorXd& weights) {
  PoseNumbers result = poses.front();
  for (std::size_t i = 1; i < poses.size(); ++i) {
    result += weights[static_cast<Eigen::Index>(i)] * (poses[i] - poses.front());
  }
  result[kAngle] = blended_angle(poses, weights);
  return result;
}

}  // namespace deformlab
