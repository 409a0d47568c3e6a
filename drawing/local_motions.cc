#include "drawing/local_motions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace deformlab {
namespace {

constexpr std::size_t kMostVertices = 200;  // of one motion
constexpr double kLeastReach = 1.5;         // in lengths of the longest edge at the vertex

}  // namespace

Eigen::Map<const Eigen::VectorXcd> as_complex(const Eigen::Matrix2Xd& V) {
  return {reinterpret_cast<const std::complex<double>*>(V.data()), V.cols()};
}

LocalMotions::LocalMotions(const Triangulation& rest)
    : rest_(as_complex(rest.V)), neighbours_(static_cast<std::size_t>(rest.V.cols())) {
  for (const auto f : rest.F.colwise()) {
    for (int c = 0; c < 3; ++c) {
      const int i = f[c], j = f[(c + 1) % 3];
      neighbours_[i].push_back(j);
      neighbours_[j].push_back(i);
      edge_ += std::abs(rest_[i] - rest_[j]) / static_cast<double>(rest.F.size());
    }
  }
}

/// The vertices that are nearest along the edges, in the order of their distances (Dijkstra).
const std::vector<LocalMotions::Near>& LocalMotions::around(int vertex) {
  const auto [known, added] = around_.try_emplace(vertex);
  std::vector<Near>& result = known->second;
  if (!added) return result;
  std::set<std::pair<double, int>> front{{0.0, vertex}};
  std::map<int, double> best{{vertex, 0.0}};
  while (!front.empty() && result.size() < kMostVertices) {
    const auto [distance, i] = *front.begin();
    front.erase(front.begin());
    result.push_back({distance, i});
    for (const int j : neighbours_[i]) {
      const double there = distance + std::abs(rest_[i] - rest_[j]);
      const auto [old, first] = best.try_emplace(j, there);
      if (!first && old->second <= there) continue;
      front.erase({old->second, j});
      old->second = there;
      front.insert({there, j});
    }
  }
  return result;
}

/// The distance from which on weights are 0.
double LocalMotions::reach(int vertex, int level) {
  double longest = 0;
  for (const int j : neighbours_[vertex])
    longest = std::max(longest, std::abs(rest_[vertex] - rest_[j]));
  const std::vector<Near>& near = around(vertex);
  const double wanted = std::max(2 * std::ldexp(edge_, level), kLeastReach * longest);
  if (near.size() < kMostVertices) return wanted;
  return std::max(std::min(wanted, near.back().distance), kLeastReach * longest);
}

int LocalMotions::number(int vertex, int level) {
  const auto [known, added] = number_.try_emplace({vertex, level}, -1);
  if (added) known->second = fit(vertex, level);
  return known->second;
}

int LocalMotions::fit(int vertex, int level) {
  const double far = reach(vertex, level);
  Fit result{vertices_.size(), vertices_.size(), 0};
  double sum = 0;
  for (const Near& near : around(vertex)) {
    const double t = near.distance / far;
    if (t >= 1) break;
    vertices_.push_back(near.vertex);
    weights_.push_back((1 - t * t) * (1 - t * t));
    sum += weights_.back();
  }
  result.end = vertices_.size();
  for (std::size_t k = result.begin; k < result.end; ++k) {
    weights_[k] /= sum;
    result.center += weights_[k] * rest_[vertices_[k]];
  }
  for (std::size_t k = result.begin; k < result.end; ++k)
    arms_.push_back(weights_[k] * std::conj(rest_[vertices_[k]] - result.center));
  fits_.push_back(result);
  return static_cast<int>(fits_.size()) - 1;
}

std::vector<RigidMotion> LocalMotions::operator()(const Eigen::Matrix2Xd& V) const {
  const auto z = as_complex(V);
  std::vector<RigidMotion> motions;
  motions.reserve(fits_.size());
  for (const Fit& fit : fits_) {
    RigidMotion motion{0, fit.center, 0};
    double size = 0;
    for (std::size_t k = fit.begin; k < fit.end; ++k) {
      const std::complex<double> turned = arms_[k] * z[vertices_[k]];
      motion.to += weights_[k] * z[vertices_[k]];
      motion.turn += turned;
      size += std::abs(turned);
    }
    const double length = std::abs(motion.turn);
    const bool turns = length > size * std::numeric_limits<double>::epsilon();
    motion.turn = turns ? motion.turn / length : 1;
    motions.push_back(motion);
  }
  return motions;
}

}  // namespace deformlab
