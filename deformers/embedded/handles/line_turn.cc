#include "deformers/embedded/handles/line_turn.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>
#include <numbers>

namespace deformlab {
namespace {

constexpr double kSamePlace = 1e-12;  // relative to the coordinates
constexpr double kHalfTurn = 1e-6;    // [rad] to a half turn, where the lines have hardly an axis

// The points relative to their centroid, or nothing where they are at one place.
std::optional<Eigen::Matrix3Xd> arms(const Eigen::Matrix3Xd& points) {
  if (points.cols() < 2) return std::nullopt;
  Eigen::Matrix3Xd result = points.colwise() - points.rowwise().mean();
  const double place = kSamePlace * points.cwiseAbs().maxCoeff();
  if (!(result.cwiseAbs().maxCoeff() > place)) return std::nullopt;
  return result;
}

// A unit vector that is perpendicular to a unit vector, as near to z as it can be.
Eigen::Vector3d across(const Eigen::Vector3d& line) {
  const Eigen::Vector3d up =
      std::abs(line.z()) < 0.9 ? Eigen::Vector3d::UnitZ().eval() : Eigen::Vector3d::UnitY().eval();
  return (up - up.dot(line) * line).normalized();
}

}  // namespace

std::optional<Eigen::Vector3d> shortest_turn(const Eigen::Matrix3Xd& p, const Eigen::Matrix3Xd& q) {
  const auto from = arms(p), to = arms(q);
  if (!from || !to) return std::nullopt;
  // The pair of directions whose match says most about where the points go.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(*to * from->transpose(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (!(svd.singularValues()[0] > 0)) return std::nullopt;
  const Eigen::Vector3d before = svd.matrixV().col(0), after = svd.matrixU().col(0);
  const Eigen::Vector3d axis = before.cross(after);
  const double sine = axis.norm(), angle = std::atan2(sine, before.dot(after));
  if (angle > std::numbers::pi - kHalfTurn) return Eigen::Vector3d(angle * across(before));
  return sine > 0 ? Eigen::Vector3d(angle / sine * axis) : Eigen::Vector3d::Zero();
}

}  // namespace deformlab
