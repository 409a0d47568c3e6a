#include "geometry/plane/boundary_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/plane/cross.h"
#include "geometry/plane/polygons.h"

namespace deformlab {
namespace {

using Eigen::Index;

// Lengths along the boundary and distances from it are in units of the local spacing.
constexpr double kPiece = 1.0 / 16;                     // length of the pieces of a curve
constexpr double kReach = 0.5;                          // length over which an angle is measured
constexpr double kSharp = 40 * std::numbers::pi / 180;  // least angle of a sharp corner
constexpr double kTolerance = 0.1;                      // distance of the boundary from a chord
constexpr int kFew = 4;           // an arc of at most so many chords may get twice as many
constexpr int kMostRounds = 100;  // of tightening

// A closed polygon, cut into short pieces, and the chords that replace it. Indices of its points
// continue after a whole turn: i + size() is the same point as i.
class Curve {
 public:
  Curve(const Eigen::Matrix2Xd& polygon, const Spacing& spacing) {
    cut(polygon, spacing);
    tolerance_.assign(size(), kTolerance);
    find_corners();
    choose();
  }

  Eigen::Matrix2Xd chosen() const { return P_(Eigen::all, chosen_); }

  // Halves the distance that the boundary may have from a chord, or from all of them.
  void tighten(Index chord) {
    const bool last = chord + 1 == static_cast<Index>(chosen_.size());
    tighten(chosen_[chord], last ? chosen_[0] + size() : chosen_[chord + 1]);
  }
  void tighten_all() { tighten(0, size()); }

  void choose() {
    chosen_.clear();
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      const bool last = c + 1 == corners_.size();
      divide(corners_[c], last ? corners_[0] + size() : corners_[c + 1]);
    }
    for (Index& i : chosen_) i %= size();
    std::ranges::sort(chosen_);
  }

 private:
  Index size() const { return P_.cols(); }
  Eigen::Vector2d at(Index i) const { return P_.col(i % size()); }
  double along(Index i) const {
    const Index turns = i / size();
    return along_[i % size()] + turns * around_;
  }

  void cut(const Eigen::Matrix2Xd& polygon, const Spacing& spacing);
  void find_corners();
  double turn(Index i) const;
  Index index(double along) const;
  double excess(Index i, Index from, Index to) const;
  std::vector<Index> even(Index from, Index to, int chords) const;
  Index worst(const std::vector<Index>& ends) const;
  void divide(Index from, Index to);
  void tighten(Index from, Index to) {
    for (Index i = from; i <= to; ++i) tolerance_[i % size()] /= 2;
  }

  Eigen::Matrix2Xd P_;
  std::vector<double> spacing_, tolerance_, along_;
  double around_ = 0;                   // length of the whole curve
  std::vector<Index> given_, corners_;  // the polygon's own corners, and those that are sharp
  std::vector<Index> chosen_;
};

void Curve::cut(const Eigen::Matrix2Xd& polygon, const Spacing& spacing) {
  std::vector<Eigen::Vector2d> points;
  for (Index c = 0; c < polygon.cols(); ++c) {
    const Eigen::Vector2d from = polygon.col(c), to = polygon.col((c + 1) % polygon.cols());
    const double length = (to - from).norm() / std::min(spacing(from), spacing(to));
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / kPiece)));
    given_.push_back(static_cast<Index>(points.size()));
    for (int k = 0; k < pieces; ++k) points.push_back(from + (to - from) * k / pieces);
  }
  P_ = Eigen::Map<Eigen::Matrix2Xd>(points[0].data(), 2, static_cast<Index>(points.size()));
  for (const auto& point : points) spacing_.push_back(spacing(point));
  for (Index i = 0; i < size(); ++i) {
    along_.push_back(around_);
    const double middle = (spacing_[i] + spacing_[(i + 1) % size()]) / 2;
    around_ += (at(i + 1) - at(i)).norm() / middle;
  }
}

// The point that is nearest to a length along the curve, which is at most two turns.
Index Curve::index(double place) const {
  const Index turns = place >= around_ ? 1 : 0;
  const auto next = std::ranges::upper_bound(along_, place - turns * around_);
  const Index after = next - along_.begin() + turns * size();
  const bool nearer = along(after) - place < place - along(after - 1);
  return nearer ? after : after - 1;
}

// The angle by which the curve turns at a point, between its chords over kReach on either side.
double Curve::turn(Index i) const {
  const double reach = std::min(kReach, around_ / 4);
  const Eigen::Vector2d before = at(i) - at(index(along(i + size()) - reach));
  const Eigen::Vector2d after = at(index(along(i) + reach)) - at(i);
  return std::abs(std::atan2(cross(before, after), before.dot(after)));
}

// Takes the sharpest corners first and none within reach of a sharper one. A curve without a sharp
// corner gets one where it turns most.
void Curve::find_corners() {
  std::vector<std::pair<double, Index>> turns;
  for (const Index i : given_) turns.emplace_back(-turn(i), i);
  std::ranges::sort(turns);
  for (const auto& [negative, i] : turns) {
    if (-negative < kSharp && !corners_.empty()) break;
    const auto beside = std::ranges::lower_bound(corners_, i);
    const auto apart = [&](Index a, Index b) { return along(b) - along(a) >= kReach; };
    if (!corners_.empty()) {
      const bool end = beside == corners_.end(), begin = beside == corners_.begin();
      const Index after = end ? corners_.front() + size() : *beside;
      const Index before = begin ? corners_.back() : *std::prev(beside);
      if (!apart(i, after) || !apart(before, begin ? i + size() : i)) continue;
    }
    corners_.insert(beside, i);
  }
}

// By how much the distance of a point from the chord between two others is greater than allowed.
double Curve::excess(Index i, Index from, Index to) const {
  const Eigen::Vector2d chord = at(to) - at(from), offset = at(i) - at(from);
  const double length = chord.squaredNorm();
  const double t = length > 0 ? std::clamp(offset.dot(chord) / length, 0.0, 1.0) : 0;
  return (offset - t * chord).norm() / spacing_[i % size()] - tolerance_[i % size()];
}

std::vector<Index> Curve::even(Index from, Index to, int chords) const {
  std::vector<Index> ends{from};
  const double length = along(to) - along(from);
  for (int k = 1; k < chords; ++k) {
    const Index next = index(along(from) + length * k / chords);
    if (next > ends.back() && next < to) ends.push_back(next);
  }
  ends.push_back(to);
  return ends;
}

// The point with the greatest excess, or -1 where all chords are close enough.
Index Curve::worst(const std::vector<Index>& ends) const {
  Index result = -1;
  double most = 0;
  for (std::size_t c = 0; c + 1 < ends.size(); ++c) {
    for (Index i = ends[c] + 1; i < ends[c + 1]; ++i) {
      const double here = excess(i, ends[c], ends[c + 1]);
      if (here > most) most = here, result = i;
    }
  }
  return result;
}

// Spaces the chosen points of an arc evenly, on a short arc more closely where that suffices.
// Otherwise it divides the arc at the point with the greatest excess.
void Curve::divide(Index from, Index to) {
  const double length = along(to) - along(from);
  const bool closed = to - from == size();
  const int fewest = std::max(closed ? 3 : 1, static_cast<int>(std::lround(length)));
  const int most = fewest <= kFew ? 2 * fewest : fewest;
  Index split = -1;
  for (int chords = fewest; chords <= most; ++chords) {
    const std::vector<Index> ends = even(from, to, chords);
    const Index farthest = worst(ends);
    if (farthest < 0) {
      chosen_.insert(chosen_.end(), ends.begin(), ends.end() - 1);
      return;
    }
    if (chords == fewest) split = farthest;
  }
  divide(from, split);
  divide(split, to);
}

// Tightens the curves whose chords meet or lie on the wrong side of each other. This comes to an
// end, because a curve that is always tightened becomes the given polygon.
bool tighten(std::vector<Curve>& curves, const Polygons& polygons) {
  bool tightened = false;
  for_edges_that_meet(polygons, [&](const PolygonEdge& e, const PolygonEdge& f) {
    curves[e.polygon].tighten(e.corner);
    curves[f.polygon].tighten(f.corner);
    tightened = true;
  });
  if (tightened) return true;
  const std::vector<std::vector<int>> around = nesting(polygons);
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    if (around[p] == std::vector<int>(p == 0 ? 0 : 1, 0)) continue;
    tightened = true;
    curves[0].tighten_all();
    curves[p].tighten_all();
    for (const int outer : around[p]) curves[outer].tighten_all();
  }
  return tightened;
}

}  // namespace

Region resampled(const Region& region, const Spacing& spacing) {
  std::vector<Curve> curves{{region.outline, spacing}};
  for (const auto& hole : region.holes) curves.emplace_back(hole, spacing);
  for (int round = 0; round < kMostRounds; ++round) {
    Polygons polygons;
    for (const Curve& curve : curves) polygons.push_back(curve.chosen());
    if (!tighten(curves, polygons)) {
      return {polygons[0], {polygons.begin() + 1, polygons.end()}};
    }
    for (Curve& curve : curves) curve.choose();
  }
  return region;
}

}  // namespace deformlab
