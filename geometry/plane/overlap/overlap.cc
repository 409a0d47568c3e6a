#include "geometry/plane/overlap/overlap.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>
#include <tuple>

#include "geometry/core/error.h"
#include "geometry/core/pair_table.h"
#include "geometry/plane/overlap/overlap_triangles.h"

namespace deformlab {
namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, int>;

constexpr double kMostCoordinate = 1e100;

// Thrown to end a search that would fill the memory.
struct TooTangled {};

Eigen::Matrix3Xi neighbours_of(const Eigen::Matrix3Xi& F) {
  struct Side {
    int low, high, triangle, edge;
    bool upward;  // whether the side runs from the lower vertex index to the higher
  };
  std::vector<Side> sides;
  for (int t = 0; t < F.cols(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int from = F(k, t), to = F((k + 1) % 3, t);
      sides.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
    }
  }
  const auto ends = [](const Side& s) { return std::tuple(s.low, s.high); };
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.low, s.high, s.triangle); });
  Eigen::Matrix3Xi neighbours = Eigen::Matrix3Xi::Constant(3, F.cols(), -1);
  for (auto it = sides.begin(); it != sides.end();) {
    const auto next = std::find_if(it, sides.end(), [&](auto& s) { return ends(s) != ends(*it); });
    if (next - it == 2 && it[0].upward != it[1].upward) {
      neighbours(it[0].edge, it[0].triangle) = it[1].triangle;
      neighbours(it[1].edge, it[1].triangle) = it[0].triangle;
    }
    it = next;
  }
  return neighbours;
}

void check(const Eigen::Matrix2Xd& V, Eigen::Index vertices) {
  std::ostringstream what;
  if (V.cols() != vertices) {
    what << "there are " << V.cols() << " deformed vertices; at rest there are " << vertices;
    throw InputError(what.str());
  }
  for (Eigen::Index i = 0; i < V.cols(); ++i) {
    if ((V.col(i).array().abs() <= kMostCoordinate).all()) continue;
    what << "deformed vertex " << i << " is at (" << V(0, i) << ", " << V(1, i)
         << "); coordinates must be finite and within ±" << kMostCoordinate
         << ": mend the handles, or scale the shape";
    throw InputError(what.str());
  }
}

class Search {
 public:
  Search(const Eigen::Matrix3Xi& F, const Eigen::Matrix3Xi& neighbours, const Eigen::Matrix2Xd& V)
      : F_(F), neighbours_(neighbours), V_(V), most_pairs_(16 * F.cols() + (1 << 17)) {}

  Overlaps run() {
    for (int t = 0; t < F_.cols(); ++t) {
      const TriangleCorners c = corners(t);
      turns_.push_back(static_cast<std::int8_t>(turn(c.col(0), c.col(1), c.col(2))));
      result_.turned_over += turns_.back() < 0;
    }
    try {
      for (const auto& [a, b] : pairs_at_rims()) grow(a, b);
    } catch (const TooTangled&) {
      return {{}, {}, 0, result_.turned_over, false};
    }
    return std::move(result_);
  }

 private:
  using Seed = std::pair<int, int>;

  TriangleCorners corners(int t) const { return V_(Eigen::all, F_.col(t)); }
  TurnedTriangle turned(int t) const { return {corners(t), turns_[t]}; }
  bool has_area(int t) const { return t >= 0 && turns_[t] != 0; }
  // Whether the sheet ends or turns over at edge k of a triangle with area.
  bool rim(int k, int t) const {
    return neighbours_(k, t) < 0 || turns_[neighbours_(k, t)] != turns_[t];
  }
  bool has_rim(int t) const { return rim(0, t) || rim(1, t) || rim(2, t); }

  std::vector<Seed> pairs_at_rims() const;
  bool apart_at_once(int a, int b) const;
  void grow(int a, int b);
  void expand(int pair);
  void go_on(int a, int b, const MutualSides& sides);
  void go_along(int a, int b, int i, int j);
  void reach(int a, int b);

  const Eigen::Matrix3Xi& F_;
  const Eigen::Matrix3Xi& neighbours_;
  const Eigen::Matrix2Xd& V_;
  const Eigen::Index most_pairs_;
  std::vector<std::int8_t> turns_;  // the sign of each triangle's orientation, 0 without area
  PairTable index_;                 // of each pair in result_.pairs
  Overlaps result_;
};

// Neighbours of the same orientation lie on different sides of their edge and do not overlap.
bool Search::apart_at_once(int a, int b) const {
  return turns_[a] == turns_[b] && (neighbours_.col(a).array() == b).any();
}

// All overlapping pairs of which a triangle has an edge where its sheet ends or turns over. Every
// region contains such a pair.
std::vector<Search::Seed> Search::pairs_at_rims() const {
  std::vector<Box> all, with_rim;
  for (int t = 0; t < F_.cols(); ++t) {
    if (!has_area(t)) continue;
    const TriangleCorners c = corners(t);
    Eigen::Vector2d low = c.rowwise().minCoeff(), high = c.rowwise().maxCoeff();
    all.emplace_back(low.data(), high.data(), t);
    if (has_rim(t)) with_rim.push_back(all.back());
  }
  std::vector<Seed> seeds;
  Eigen::Index candidates = 0;
  const auto test = [&](const Box& one, const Box& other) {
    const int a = one.info(), b = other.info();
    if (a == b || (a > b && has_rim(b)) || apart_at_once(a, b)) return;
    if (++candidates > most_pairs_) throw TooTangled();
    if (MutualSides::of_overlapping(turned(a), turned(b))) seeds.push_back(std::minmax(a, b));
  };
  CGAL::box_intersection_d(with_rim.begin(), with_rim.end(), all.begin(), all.end(), test);
  std::ranges::sort(seeds);
  return seeds;
}

// Adds the region that contains a pair, unless that pair is known already.
void Search::grow(int a, int b) {
  if (index_.find(a, b) != PairTable::kNone) return;
  const int first = static_cast<int>(result_.pairs.size());
  result_.regions.push_back({first, 0});
  reach(a, b);
  for (int pair = first; pair < static_cast<int>(result_.pairs.size()); ++pair) expand(pair);
  result_.regions.back().count = static_cast<int>(result_.pairs.size()) - first;
  result_.area += result_.regions.back().area;
}

void Search::expand(int pair) {
  const auto [a, b, unknown] = result_.pairs[pair];
  const TurnedTriangle A = turned(a), B = turned(b);
  const double area = convex_area(intersection(A, B));
  result_.pairs[pair].area = area;
  result_.regions.back().area += area;
  go_on(a, b, *MutualSides::of_overlapping(A, B));
}

void Search::go_on(int a, int b, const MutualSides& sides) {
  for (int i = 0; i < 3; ++i) {
    if (sides.a_enters(i)) reach(neighbours_(i, a), b);
    if (sides.b_enters(i)) reach(a, neighbours_(i, b));
    for (int j = 0; j < 3; ++j) {
      if (sides.on_one_line(i, j)) go_along(a, b, i, j);
      const bool boundary = neighbours_(i, a) < 0 && neighbours_(j, b) < 0;
      result_.regions.back().crossings += boundary && sides.cross(i, j);
    }
  }
}

// Where two edges lie on each other, a step crosses both. A fold is crossed alone, because its two
// triangles lie on the same side of the edge.
void Search::go_along(int a, int b, int i, int j) {
  if (!share_a_length(V_.col(F_(i, a)), V_.col(F_((i + 1) % 3, a)), V_.col(F_(j, b)),
                      V_.col(F_((j + 1) % 3, b))))
    return;
  const int next_a = neighbours_(i, a), next_b = neighbours_(j, b);
  const bool fold_a = has_area(next_a) && turns_[next_a] != turns_[a];
  const bool fold_b = has_area(next_b) && turns_[next_b] != turns_[b];
  if (fold_a) reach(next_a, b);
  if (fold_b) reach(a, next_b);
  if (!fold_a && !fold_b) reach(next_a, next_b);
}

void Search::reach(int a, int b) {
  if (!has_area(a) || !has_area(b) || a == b) return;
  const int known = index_.enter(a, b, static_cast<int>(result_.pairs.size()));
  if (known != PairTable::kNone) {
    if (result_.pairs[known].a != a) result_.regions.back().twisted = true;
    return;
  }
  if (static_cast<Eigen::Index>(result_.pairs.size()) == most_pairs_) throw TooTangled();
  result_.pairs.push_back({a, b, 0});
}

}  // namespace

OverlapFinder::OverlapFinder(const Triangulation& rest) : vertices_(rest.V.cols()), F_(rest.F) {
  check(rest);
  neighbours_ = neighbours_of(F_);
}

Overlaps OverlapFinder::operator()(const Eigen::Matrix2Xd& V) const {
  check(V, vertices_);
  return Search(F_, neighbours_, V).run();
}

}  // namespace deformlab
