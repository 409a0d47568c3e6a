#include "experiments/scenes/gallop.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "experiments/scenes/surface_nets.h"

namespace deformlab {
namespace {

using Eigen::Vector3d;

enum Joint {
  kPelvis,
  kSpine,
  kNeck,
  kHead,
  kTail,
  kTailEnd,
  kShoulder,
  kKnee,
  kFetlock,  // the left fore leg; 3 joints of the right one follow
  kHip = kShoulder + 6,
  kStifle,
  kHock,  // the left hind leg; 3 joints of the right one follow
  kJoints = kHip + 6
};

// The point that a joint turns about, on an axis across the body, and the joint that moves it.
struct JointPlace {
  int parent;
  Vector3d at;
};

// A limb is the volume of a ball that moves from a to b while its radius changes. It moves with its
// joint.
struct Limb {
  int joint;
  Vector3d a, b;
  double radius_a, radius_b;
  double blend;  // the width of the smooth transition to other limbs [length]
};

Vector3d right(Vector3d p, bool mirrored) {
  if (mirrored) p.y() = -p.y();
  return p;
}

std::array<JointPlace, kJoints> joints() {
  std::array<JointPlace, kJoints> j{};
  j[kPelvis] = {-1, {-0.55, 0, 1.15}};
  j[kSpine] = {kPelvis, {0.0, 0, 1.15}};
  j[kNeck] = {kSpine, {0.62, 0, 1.25}};
  j[kHead] = {kNeck, {1.12, 0, 1.72}};
  j[kTail] = {kPelvis, {-0.85, 0, 1.22}};
  j[kTailEnd] = {kTail, {-1.08, 0, 1.0}};
  for (const bool mirrored : {false, true}) {
    const int side = mirrored ? 3 : 0;
    j[kShoulder + side] = {kSpine, right({0.55, 0.17, 1.05}, mirrored)};
    j[kKnee + side] = {kShoulder + side, right({0.56, 0.17, 0.52}, mirrored)};
    j[kFetlock + side] = {kKnee + side, right({0.55, 0.17, 0.17}, mirrored)};
    j[kHip + side] = {kPelvis, right({-0.60, 0.17, 1.08}, mirrored)};
    j[kStifle + side] = {kHip + side, right({-0.48, 0.18, 0.78}, mirrored)};
    j[kHock + side] = {kStifle + side, right({-0.74, 0.17, 0.50}, mirrored)};
  }
  return j;
}

std::vector<Limb> body() {
  return {
      {kPelvis, {-0.62, 0, 1.10}, {-0.10, 0, 1.08}, 0.27, 0.27, 0.10},
      {kSpine, {-0.10, 0, 1.08}, {0.50, 0, 1.10}, 0.27, 0.25, 0.10},
      {kNeck, {0.62, 0, 1.22}, {1.08, 0, 1.68}, 0.19, 0.105, 0.10},
      {kHead, {1.12, 0, 1.72}, {1.46, 0, 1.50}, 0.12, 0.075, 0.05},
      {kHead, {1.38, 0, 1.55}, {1.50, 0, 1.46}, 0.085, 0.07, 0.03},
      {kTail, {-0.84, 0, 1.22}, {-1.08, 0, 1.0}, 0.06, 0.065, 0.05},
      {kTailEnd, {-1.08, 0, 1.0}, {-1.18, 0, 0.62}, 0.065, 0.04, 0.05},
  };
}

std::vector<Limb> limbs_of_a_side(bool mirrored) {
  const int side = mirrored ? 3 : 0;
  std::vector<Limb> limbs{
      {kHead, {1.14, 0.07, 1.80}, {1.11, 0.085, 1.92}, 0.035, 0.025, 0.02},  // ear
      {kHead, {1.25, 0.085, 1.69}, {1.26, 0.085, 1.68}, 0.03, 0.03, 0.01},   // eye
      {kHead, {1.50, 0.045, 1.50}, {1.51, 0.045, 1.50}, 0.03, 0.03, 0.01},   // nostril
      {kShoulder + side, {0.55, 0.13, 1.05}, {0.56, 0.17, 0.54}, 0.15, 0.068, 0.08},
      {kKnee + side, {0.56, 0.17, 0.52}, {0.55, 0.17, 0.17}, 0.066, 0.05, 0.03},
      {kFetlock + side, {0.55, 0.17, 0.17}, {0.61, 0.17, 0.06}, 0.054, 0.066, 0.03},
      {kHip + side, {-0.60, 0.12, 1.06}, {-0.50, 0.17, 0.80}, 0.21, 0.13, 0.08},
      {kStifle + side, {-0.48, 0.17, 0.80}, {-0.72, 0.17, 0.52}, 0.12, 0.066, 0.06},
      {kHock + side, {-0.74, 0.17, 0.50}, {-0.68, 0.17, 0.17}, 0.064, 0.052, 0.03},
      {kHock + side, {-0.68, 0.17, 0.17}, {-0.62, 0.17, 0.06}, 0.054, 0.066, 0.03},
  };
  for (Limb& limb : limbs) {
    limb.a = right(limb.a, mirrored);
    limb.b = right(limb.b, mirrored);
  }
  return limbs;
}

std::vector<Limb> all_limbs() {
  std::vector<Limb> limbs = body();
  for (const bool mirrored : {false, true}) {
    for (const Limb& limb : limbs_of_a_side(mirrored)) limbs.push_back(limb);
  }
  return limbs;
}

// The distance of a point from the surface of a limb, negative within.
double distance(const Limb& limb, const Vector3d& p) {
  const Vector3d along = limb.b - limb.a;
  const double t = std::clamp((p - limb.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - limb.a - t * along).norm() - (1 - t) * limb.radius_a - t * limb.radius_b;
}

double smooth_minimum(double a, double b, double blend) {
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - h * h * blend / 4;
}

double skin(const std::vector<Limb>& limbs, const Vector3d& p) {
  double result = distance(limbs.front(), p);
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    result = smooth_minimum(result, distance(limbs[i], p), limbs[i].blend);
  }
  return result;
}

Eigen::VectorXd influence_at(const std::vector<Limb>& limbs, const Vector3d& p) {
  Eigen::VectorXd w = Eigen::VectorXd::Zero(kJoints);
  for (const Limb& limb : limbs) {
    const double away = std::max(distance(limb, p), 0.0) + 0.03;
    w[limb.joint] = std::max(w[limb.joint], std::pow(away, -4));
  }
  return w / w.sum();
}

constexpr double kDegree = std::numbers::pi / 180;

// The angle of each joint about the axis that points to the left. A positive one swings a leg back.
std::array<double, kJoints> angles(double time) {
  const double cycle = 2 * std::numbers::pi * time;
  std::array<double, kJoints> a{};
  a[kPelvis] = 5 * std::sin(cycle);
  a[kSpine] = -8 * std::sin(cycle);
  a[kNeck] = 8 * std::sin(cycle + 0.6) + 1.2 * std::sin(5 * cycle);
  a[kHead] = -6 * std::sin(cycle + 0.9) + 1.2 * std::sin(5 * cycle + 1);
  a[kTail] = 25 + 10 * std::sin(cycle + 2);
  a[kTailEnd] = 10 * std::sin(cycle + 1.2);
  const double lead[] = {
      0.0, 0.10, 0.52,
      0.62};  // as parts of a cycle: left and right fore leg, left and right hind leg
  for (int leg = 0; leg < 4; ++leg) {
    const double phase = cycle - 2 * std::numbers::pi * lead[leg];
    const double lifted = std::pow((1 + std::cos(phase)) / 2, 2);
    const int side = leg % 2 == 0 ? 0 : 3;
    if (leg < 2) {
      a[kShoulder + side] = -32 * std::sin(phase);
      a[kKnee + side] = 75 * lifted;
      a[kFetlock + side] = 40 * lifted;
    } else {
      a[kHip + side] = -30 * std::sin(phase) - 8 * lifted;
      a[kStifle + side] = 38 * lifted;
      a[kHock + side] = -48 * lifted;
    }
  }
  for (double& angle : a) angle *= kDegree;
  return a;
}

}  // namespace

Gallop::Gallop(double cell) {
  const std::vector<Limb> limbs = all_limbs();
  rest_ = surface_nets([&](const Vector3d& p) { return skin(limbs, p); }, {-1.5, -0.6, -0.2},
                       {1.8, 0.6, 2.2}, cell);
  influence_.resize(kJoints, rest_.V.cols());
  for (Eigen::Index i = 0; i < rest_.V.cols(); ++i) {
    influence_.col(i) = influence_at(limbs, rest_.V.col(i));
  }
}

Shape Gallop::pose(double time) const {
  const auto all = joints();
  const auto turned = angles(time);
  std::array<Eigen::Isometry3d, kJoints> motion;
  for (int j = 0; j < kJoints; ++j) {  // parents come first
    const bool root = all[j].parent < 0;
    motion[j] = root ? Eigen::Isometry3d(
                           Eigen::Translation3d(0, 0, 0.05 * std::sin(4 * std::numbers::pi * time)))
                     : motion[all[j].parent];
    motion[j] = motion[j] * Eigen::Translation3d(all[j].at) *
                Eigen::AngleAxisd(turned[j], Vector3d::UnitY()) * Eigen::Translation3d(-all[j].at);
  }
  Shape shape = rest_;
  for (Eigen::Index i = 0; i < shape.V.cols(); ++i) {
    Vector3d sum = Vector3d::Zero();
    for (int j = 0; j < kJoints; ++j) sum += influence_(j, i) * (motion[j] * rest_.V.col(i));
    shape.V.col(i) = sum;
  }
  return shape;
}

}  // namespace deformlab
