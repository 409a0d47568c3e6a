#include "experiments/subjects/shape/edit_motion.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <limits>
#include <numbers>

namespace deformlab {
namespace {

constexpr double kRigid = 0.01;  // relative to the extent of the points
constexpr double kFlat = 1e-6;   // singular values relative to the first: the points lie on a line

Eigen::Vector3d known(const Eigen::Vector3d& turn) {
  return turn.hasNaN() ? Eigen::Vector3d(0, 0, 0) : turn;
}

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& turn) {
  if (turn.isZero(0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()).toRotationMatrix();
}

}  // namespace

bool is_translation(const Motion& motion) {
  return known(motion.turn).isZero(0) && motion.stretch == Eigen::Matrix3d::Identity();
}

namespace {

// What the motion adds to a place, apart from its translation.
Eigen::Vector3d bent(const Motion& motion, const Eigen::Vector3d& rest) {
  if (is_translation(motion)) return Eigen::Vector3d::Zero();
  const Eigen::Matrix3d linear = rotation_of(known(motion.turn)) * motion.stretch;
  return (linear - Eigen::Matrix3d::Identity()) * (rest - motion.center);
}

PoseNumbers numbers_of(const Pose& pose, const Eigen::Vector3d& center) {
  Motion motion = pose.motion;
  motion.center = center;
  PoseNumbers numbers;
  numbers << known(motion.turn), motion.stretch.reshaped(), motion.center, pose.rest,
      pose.offset - bent(motion, pose.rest);
  return numbers;
}

// The centre of the nearest pose that is no translation, or else of pose i itself.
Eigen::Vector3d center_for(const std::vector<Pose>& poses, std::size_t i) {
  for (std::size_t away = 0; away < poses.size(); ++away) {
    if (i >= away && !is_translation(poses[i - away].motion)) return poses[i - away].motion.center;
    if (i + away < poses.size() && !is_translation(poses[i + away].motion)) {
      return poses[i + away].motion.center;
    }
  }
  return poses[i].motion.center;
}

// Where points lie on a line, their positions do not tell how they turn.
bool are_on_a_line(const Eigen::Matrix3Xd& P) {
  const Eigen::Matrix3Xd arms = P.colwise() - P.rowwise().mean();
  const Eigen::Vector3d s =
      Eigen::JacobiSVD<Eigen::Matrix3d>(arms * arms.transpose()).singularValues();
  return !(s[1] > kFlat * s[0]);
}

// Splits a matrix into a rotation and a stretch before it.
void split(const Eigen::Matrix3d& linear, Motion& motion) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d& V = svd.matrixV();
  Eigen::Vector3d sign(1, 1, (svd.matrixU() * V.transpose()).determinant() < 0 ? -1 : 1);
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(svd.matrixU() * sign.asDiagonal() * V.transpose()));
  motion.turn = turn.angle() * turn.axis();
  motion.stretch = V * sign.cwiseProduct(svd.singularValues()).asDiagonal() * V.transpose();
}

}  // namespace

Eigen::Vector3d Motion::operator()(const Eigen::Vector3d& p) const {
  if (is_translation(*this)) return p + shift;
  return center + rotation_of(known(turn)) * (stretch * (p - center)) + shift;
}

Motion motion_of(const EditEntry& entry, const Eigen::Matrix3Xd& P) {
  const Eigen::Vector3d centroid = P.rowwise().mean();
  Motion motion{.center = centroid};
  if (are_on_a_line(P)) motion.turn.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (entry.to) motion.shift = *entry.to - centroid;
  if (entry.matrix) {
    const Eigen::Matrix4d& M = entry.matrix->value;
    split(M.topLeftCorner<3, 3>(), motion);
    motion.shift = M.topRows<3>() * centroid.homogeneous() - centroid;
  }
  if (entry.scale) {
    motion.center = entry.scale->center.value_or(centroid);
    motion.stretch = entry.scale->factor.value.asDiagonal();
  }
  if (entry.rotate) {
    const Eigen::Vector3d scaled_about = motion.center;
    motion.center = entry.rotate->center.value_or(centroid);
    motion.turn =
        entry.rotate->degrees * std::numbers::pi / 180 * entry.rotate->axis.stableNormalized();
    // Scaling about its own centre c first is x ↦ S x + (I − S) c.
    const Eigen::Matrix3d rest = Eigen::Matrix3d::Identity() - motion.stretch;
    motion.shift += rotation_of(motion.turn) * (rest * (scaled_about - motion.center));
  }
  if (entry.by) motion.shift += *entry.by;
  return motion;
}

std::vector<PoseNumbers> numbers_of(const std::vector<Pose>& poses) {
  std::vector<PoseNumbers> numbers;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    numbers.push_back(numbers_of(poses[i], center_for(poses, i)));
  }
  return numbers;
}

Eigen::Vector3d offset_of(const PoseNumbers& numbers) {
  Motion motion;
  motion.turn = numbers.segment<3>(kTurnOfNumbers);
  motion.stretch = numbers.segment<9>(3).reshaped(3, 3);
  motion.center = numbers.segment<3>(12);
  return numbers.segment<3>(18) + bent(motion, numbers.segment<3>(15));
}

Eigen::Vector3d offset_between(const Pose& from, const Pose& to, double share) {
  const std::vector<PoseNumbers> numbers = numbers_of({from, to});
  return offset_of(numbers[0] + share * (numbers[1] - numbers[0]));
}

bool is_rigid_motion(const Eigen::Matrix3Xd& P, const Eigen::Matrix3Xd& Q) {
  if (P.cols() < 3) return false;
  const Eigen::Matrix3Xd from = P.colwise() - P.rowwise().mean(),
                         to = Q.colwise() - Q.rowwise().mean();
  const double extent = from.colwise().norm().maxCoeff();
  const Eigen::Matrix4d motion = Eigen::umeyama(from, to, false);
  const Eigen::Matrix3Xd off = motion.topLeftCorner<3, 3>() * from - to;
  return extent > 0 && off.colwise().norm().maxCoeff() <= kRigid * extent;
}

}  // namespace deformlab
