#include "experiments/subjects/particles/stream_measurements.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "deformers/embedded/node_states.h"

namespace deformlab {
namespace {

constexpr double kAlike =
    1e-12;  // a variance of speeds below this part of their mean's square is rounding

}  // namespace

void StreamMeasurements::compare(const Particle& before, const Particle& now) {
  const Eigen::Vector3d u = now.position - before.position, w = now.edited - before.edited;
  u_ += u.norm();
  w_ += w.norm();
  uu_ += u.squaredNorm();
  ww_ += w.squaredNorm();
  uw_ += u.norm() * w.norm();
  turned_off_ += (w - before.R * u).squaredNorm();
  off_ += (w - u).squaredNorm();
  ++pairs_;
}

void StreamMeasurements::add(const StreamDeformation& stream, ParticleFrame rows,
                             const Eigen::Matrix3Xd& edited) {
  std::unordered_map<std::int64_t, Particle> now;
  double carried = 0;
  const Eigen::Matrix3Xd turns = stream.rotations(positions_of(rows));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const Particle particle{rows[i].position, edited.col(column),
                            nearest_rotation(turns.middleCols<3>(3 * column))};
    now[rows[i].id] = particle;
    const auto before = last_.find(rows[i].id);
    if (before == last_.end()) continue;
    ++carried;
    compare(before->second, particle);
  }
  if (frames_ > 0) {
    born_ += static_cast<double>(now.size()) - carried;
    died_ += static_cast<double>(last_.size()) - carried;
  }
  particles_ += static_cast<double>(now.size());
  ++frames_;
  last_ = std::move(now);
}

Metrics StreamMeasurements::metrics() const {
  const double n = std::max(pairs_, 1.0), u = u_ / n, w = w_ / n;
  const double uu = uu_ / n - u * u, ww = ww_ / n - w * w;
  const double changes = std::max(frames_ - 1, 1.0);
  Metrics m{{"frames", frames_},
            {"particles", particles_ / std::max(frames_, 1.0)},
            {"born", born_ / changes},
            {"died", died_ / changes},
            {"speed_ratio", w_ / u_},
            {"velocity_error", std::sqrt(turned_off_ / uu_)},
            {"velocity_change", std::sqrt(off_ / uu_)}};
  if (uu > kAlike * u * u && ww > kAlike * w * w) {
    m["speed_correlation"] = (uw_ / n - u * w) / std::sqrt(uu * ww);
  }
  return m;
}

Metrics twist_of(const StreamDeformation& stream) {
  const DeformationGraph& graph = stream.deformation().graph();
  const Transformations X = stream.deformation().transformations();
  const auto position = [&](int j) { return (graph.g.col(j) + X.col(4 * j + 3)).eval(); };
  double sum = 0, most = 0;
  for (const GraphEdge& edge : graph.edges) {
    const Eigen::Quaterniond turn(nearest_rotation(X.middleCols<3>(4 * edge.k)) *
                                  nearest_rotation(X.middleCols<3>(4 * edge.j)).transpose());
    const Eigen::Vector3d along = (position(edge.k) - position(edge.j)).normalized();
    const double angle = std::abs(2 * std::atan2(turn.vec().dot(along), turn.w()));
    const double least = std::min(angle, 2 * std::numbers::pi - angle) * 180 / std::numbers::pi;
    sum += least;
    most = std::max(most, least);
  }
  return {{"twist", sum}, {"twist_max", most}};
}

}  // namespace deformlab
