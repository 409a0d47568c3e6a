#include "experiments/scenes/jet.h"

#include <cmath>
#include <numbers>
#include <random>

namespace deformlab {
namespace {

constexpr int kBorn = 10, kLife = 107;  // particles born in a frame, and frames of a life
constexpr double kSpeed = 6,
                 kSlower = 0.15;  // speed at the age 0, and the share that is lost with age
constexpr double kLength = kSpeed * (1 - kSlower);

// The properties in which the particles of the jet differ.
struct Nature {
  double radius, angle, phase, speed;
};

Nature nature(int id) {
  std::mt19937_64 random(static_cast<std::uint64_t>(id) + 12345);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  Nature n{std::sqrt(uniform()), 2 * std::numbers::pi * uniform(), 2 * std::numbers::pi * uniform(),
           0.94 + 0.12 * uniform()};
  if (id % kBorn == 0) n = {0, 0, n.phase, 1};
  return n;
}

// The position of a particle at an age from 0 to 1.
Eigen::Vector3d position(const Nature& n, double age) {
  const double x = kSpeed * n.speed * age * (1 - kSlower * age);
  const double wide = 0.06 + 0.42 * age;
  const double turn = n.angle + 2 * std::numbers::pi * 2.5 * age / (0.4 + n.radius);
  const double wobble = n.radius * 0.05 * std::sin(2 * std::numbers::pi * 6 * age + n.phase);
  const double r = wide * n.radius + wobble * std::sqrt(age);
  return {x, r * std::cos(turn), r * std::sin(turn)};
}

// The position of a point beside the x axis after the axis is bent to an arc of a circle.
Eigen::Vector3d bent(const Eigen::Vector3d& p, double bend) {
  const double curvature = bend * std::numbers::pi / 180 / kLength, turn = curvature * p.x();
  if (curvature == 0) return p;
  const Eigen::Vector3d middle(std::sin(turn) / curvature, 0, (1 - std::cos(turn)) / curvature);
  return middle + Eigen::Vector3d(-std::sin(turn) * p.z(), p.y(), std::cos(turn) * p.z());
}

}  // namespace

void Jet::for_each_frame(const Visit& visit) const {
  std::vector<ParticleRow> rows;
  std::int64_t number = 0;
  for (int frame = 0; frame < frames_; ++frame) {
    rows.clear();
    for (int id = frame * kBorn; id < (frame + kLife) * kBorn; ++id) {
      const int born = id / kBorn - kLife + 1;
      const double share =
          (id % kBorn) / static_cast<double>(kBorn);  // the part of a frame before its birth
      const double age = (frame - born + 1 - share) / kLife;
      rows.push_back({frame, id, bent(position(nature(id), age), bend_), number, number});
      ++number;
    }
    visit(frame, rows);
  }
}

}  // namespace deformlab
