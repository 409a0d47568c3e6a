#include "drawing/following_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr std::size_t kMostParts = 400;
constexpr double kLeastArea = 0.02;              // of a part with a mesh [edge length²]
constexpr int kFewest = 6, kMostVertices = 300;  // of a part's mesh
constexpr double kNarrow = 0.25;     // differences of the gap's width that count little [edge]
constexpr double kLeastPull = 1e-4;  // relative to the strongest pull

using Complex = std::complex<double>;
using Box = Eigen::AlignedBox2d;

/// A mesh with edges of about the given length, or none for a part that cannot have one.
std::optional<Triangulation> meshed(const Region& part, double edge) {
  const double inside = area(part) * 2 / std::sqrt(3.0), rim = perimeter(part) / 2;
  const double wanted = inside / (edge * edge) + rim / edge;
  TriangulationOptions options;
  options.vertices = static_cast<int>(std::clamp<double>(wanted, kFewest, kMostVertices));
  try {
    return triangulate(part, options, "a detached part");
  } catch (const InputError&) {
    return {};
  }
}

Box box_of(const Triangulation& mesh) {
  return {mesh.V.rowwise().minCoeff(), mesh.V.rowwise().maxCoeff()};
}

/// A weight that falls with the distance and is 1 at distance 0.
double falling(double distance, double scale) {
  const double t = scale / (scale + distance);
  return t * t * t * t;
}

}  // namespace

/// The places of the leader that are nearest to the vertices of a part.
struct FollowingParts::Gap {
  int leader = -1;
  double width = std::numeric_limits<double>::infinity();
  std::vector<Located> places = {};
};

std::vector<Triangulation> meshes_of(const std::vector<Region>& parts, const Triangulation& rest) {
  std::vector<Triangulation> result;
  const double edge = LocalMotions(rest).edge();
  for (const Region& part : parts) {
    if (result.size() == kMostParts) break;
    if (area(part) < kLeastArea * edge * edge) continue;
    if (auto mesh = meshed(part, edge)) result.push_back(*std::move(mesh));
  }
  return result;
}

FollowingParts::FollowingParts(const Triangulation& rest, std::vector<Triangulation> waiting) {
  add(rest);
  std::vector<Gap> gaps(waiting.size());
  while (!waiting.empty()) {  // the nearest part first (Prim), so that parts may follow parts
    const int leader = static_cast<int>(pieces_.size()) - 1;
    const Box around = box_of(pieces_.back().mesh);
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      if (around.exteriorDistance(box_of(waiting[i])) >= gaps[i].width) continue;
      Gap gap{leader};
      for (const auto& v : waiting[i].V.colwise()) {
        gap.places.push_back(pieces_.back().locate(v));
        gap.width = std::min(gap.width, gap.places.back().distance);
      }
      if (gap.width < gaps[i].width) gaps[i] = std::move(gap);
    }
    const auto nearest = std::ranges::min_element(gaps, {}, &Gap::width) - gaps.begin();
    attach(gaps[nearest], std::move(waiting[nearest]));
    gaps.erase(gaps.begin() + nearest);
    waiting.erase(waiting.begin() + nearest);
  }
}

void FollowingParts::add(Triangulation mesh) {
  const Eigen::Index n = all_.V.cols(), m = all_.F.cols();
  append(mesh, all_);
  Locator locate(mesh);
  LocalMotions motions(mesh);
  pieces_.push_back({std::move(mesh), std::move(locate), std::move(motions), n, m});
}

/// A vertex of the leader pulls the more, the narrower the gap is there, and pulls what is near to
/// it more than what is far.
void FollowingParts::attach(const Gap& gap, Triangulation part) {
  Piece& leader = pieces_[gap.leader];
  const double edge = leader.motions.edge();
  std::map<int, double> strength;  // of the leader's vertices
  Follower follower{gap.leader, 0, {}};
  double most = 0;
  for (const Located& place : gap.places) {
    const double here = falling(place.distance - gap.width, kNarrow * edge + gap.width);
    if (place.distance == gap.width) follower.triangle = place.triangle;
    for (int c = 0; c < 3; ++c) {
      double& sum = strength[leader.mesh.F(c, place.triangle)];
      sum += here * place.b[c];
      most = std::max(most, sum);
    }
  }
  std::erase_if(strength, [&](const auto& entry) { return entry.second < kLeastPull * most; });
  const auto places = as_complex(leader.mesh.V);
  for (const Complex& x : as_complex(part.V)) {
    std::vector<Pull>& pulls = follower.pulls.emplace_back();
    double sum = 0;
    for (const auto& [vertex, pull] : strength) {
      const double weight = pull * falling(std::abs(x - places[vertex]), edge + gap.width);
      pulls.push_back({leader.motions.number(vertex, 0), weight, places[vertex]});
      sum += weight;
    }
    for (Pull& pull : pulls) pull.weight /= sum;
  }
  followers_.push_back(std::move(follower));
  add(std::move(part));
}

Eigen::Matrix2Xd FollowingParts::operator()(const Eigen::Matrix2Xd& V) const {
  Eigen::Matrix2Xd moved(2, all_.V.cols());
  moved.leftCols(V.cols()) = V;
  std::vector<std::vector<RigidMotion>> motions(pieces_.size());
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    const Piece& piece = pieces_[p];
    if (p > 0) {
      const Follower& follower = followers_[p - 1];
      for (Eigen::Index i = 0; i < piece.mesh.V.cols(); ++i) {
        Complex turn = 0, from = 0, to = 0;
        for (const Pull& pull : follower.pulls[i]) {
          const RigidMotion& motion = motions[follower.leader][pull.motion];
          turn += pull.weight * motion.turn;
          from += pull.weight * pull.place;
          to += pull.weight * motion(pull.place);
        }
        if (std::abs(turn) > 1e-9) turn /= std::abs(turn);
        const Complex x(piece.mesh.V(0, i), piece.mesh.V(1, i));
        const Complex there = to + turn * (x - from);
        moved.col(piece.first_vertex + i) << there.real(), there.imag();
      }
    }
    motions[p] = piece.motions(moved.middleCols(piece.first_vertex, piece.mesh.V.cols()));
  }
  return moved;
}

Eigen::VectorXd FollowingParts::depths(const Eigen::VectorXd& depth) const {
  if (depth.size() == 0) return depth;
  Eigen::VectorXd result(all_.F.cols());
  result.head(depth.size()) = depth;
  for (std::size_t p = 1; p < pieces_.size(); ++p) {
    const Follower& follower = followers_[p - 1];
    const Eigen::Index leading = pieces_[follower.leader].first_triangle + follower.triangle;
    result.segment(pieces_[p].first_triangle, pieces_[p].mesh.F.cols())
        .setConstant(result[leading]);
  }
  return result;
}

}  // namespace deformlab
