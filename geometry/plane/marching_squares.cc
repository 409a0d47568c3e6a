#include "geometry/plane/marching_squares.h"

#include <algorithm>
#include <array>

namespace deformlab {
namespace {

using Index = std::ptrdiff_t;
constexpr Index kNone = -1;
constexpr Index kAcross = -2;  // marks a crossing between two columns

// Where the boundary crosses a grid line. The boundary runs from each crossing to one other.
struct Crossing {
  Eigen::Vector2d at;
  Index next = kNone;
  Index above;  // the previous crossing on the same column of samples, kNone or kAcross
};

// The samples along one axis of n entries. At either end a copy of the outermost entry is on the
// border, and so is a sample below the threshold, so that a shape ends exactly at the border.
struct Axis {
  explicit Axis(Index entries) : n(entries) {}
  Index samples() const { return n + 4; }
  Index entry(Index k) const { return std::clamp<Index>(k - 2, 0, n - 1); }
  bool beyond(Index k) const { return k == 0 || k == n + 3; }
  double place(Index k) const { return std::clamp(k - 1.5, 0.0, static_cast<double>(n)); }
  Index n;
};

class MarchingSquares {
 public:
  MarchingSquares(const Eigen::ArrayXXf& field, float threshold)
      : field_(field),
        threshold_(threshold),
        x_(field.cols()),
        y_(field.rows()),
        left_(y_.samples()),
        right_(y_.samples()),
        left_crossings_(y_.samples()),
        right_crossings_(y_.samples()) {}

  std::vector<Crossing> run() {
    read_column(0);
    for (Index i = 0; i + 1 < x_.samples(); ++i) {
      left_.swap(right_);
      left_crossings_.swap(right_crossings_);
      read_column(i + 1);
      connect(i);
    }
    return std::move(crossings_);
  }

 private:
  bool inside(float value) const { return value >= threshold_; }

  // The fraction of the way from one sample to the next at which the field meets the threshold.
  double fraction(double from, double to) const {
    return std::clamp((threshold_ - from) / (to - from), 1e-3, 1 - 1e-3);
  }

  void read_column(Index i) {
    const float beyond = threshold_ - 1;
    if (x_.beyond(i)) {
      right_.setConstant(beyond);
    } else {
      const auto column = field_.col(x_.entry(i));
      right_ << beyond, column[0], column, column[y_.n - 1], beyond;
    }
    Index last = kNone;
    for (Index j = 0; j + 1 < y_.samples(); ++j) {
      right_crossings_[j] = kNone;
      if (inside(right_[j]) == inside(right_[j + 1])) continue;
      const double t = fraction(right_[j], right_[j + 1]);
      const double y = (1 - t) * y_.place(j) + t * y_.place(j + 1);
      right_crossings_[j] = add({x_.place(i), y}, last);
      last = right_crossings_[j];
    }
  }

  Index add(const Eigen::Vector2d& at, Index above) {
    crossings_.push_back({.at = at, .above = above});
    return static_cast<Index>(crossings_.size()) - 1;
  }

  Index cross(Index i, Index j) {
    const double t = fraction(left_[j], right_[j]);
    return add({(1 - t) * x_.place(i) + t * x_.place(i + 1), y_.place(j)}, kAcross);
  }

  // Connects the crossings in the squares between columns i and i + 1.
  void connect(Index i) {
    Index top = kNone;  // the uppermost samples are all beyond the border
    for (Index j = 0; j + 1 < y_.samples(); ++j) {
      const bool crossed = inside(left_[j + 1]) != inside(right_[j + 1]);
      const Index bottom = crossed ? cross(i, j + 1) : kNone;
      const std::array<Index, 4> side{top, right_crossings_[j], bottom, left_crossings_[j]};
      if (side != std::array{kNone, kNone, kNone, kNone}) {
        connect({left_[j], right_[j], right_[j + 1], left_[j + 1]}, side);
      }
      top = bottom;
    }
  }

  // Connects the crossings on the sides of a square. Side k is between corner k and the next. The
  // boundary runs from where a walk around the square leaves the shape to where it enters again.
  void connect(const std::array<float, 4>& corner, const std::array<Index, 4>& side) {
    const auto leaves = [&](int k) { return inside(corner[k]) && !inside(corner[(k + 1) % 4]); };
    const bool saddle = std::ranges::count(side, kNone) == 0;
    for (int k = 0; k < 4; ++k) {
      if (side[k] == kNone || !leaves(k)) continue;
      int enters = (k + 1) % 4;
      if (saddle) {
        if (!joined(corner)) enters = (k + 3) % 4;
      } else {
        while (side[enters] == kNone) enters = (enters + 1) % 4;
      }
      crossings_[side[k]].next = side[enters];
    }
  }

  // Whether the bilinear interpolant is at least the threshold at its saddle point.
  bool joined(const std::array<float, 4>& corner) const {
    const auto product = [&](int a, int b) {
      return (static_cast<double>(corner[a]) - threshold_) *
             (static_cast<double>(corner[b]) - threshold_);
    };
    const double one = product(0, 2), other = product(1, 3);
    return inside(corner[0]) ? one >= other : other >= one;
  }

  const Eigen::ArrayXXf& field_;
  float threshold_;
  Axis x_, y_;
  Eigen::ArrayXf left_, right_;  // samples on either side of the squares at hand
  std::vector<Index> left_crossings_, right_crossings_;
  std::vector<Crossing> crossings_;
};

// The closed polygons through the crossings, without corners that repeat or lie on a straight line.
class Loops {
 public:
  explicit Loops(std::vector<Crossing> crossings)
      : crossings_(std::move(crossings)), loop_of_(crossings_.size(), kNone) {
    for (Index c = 0; c < static_cast<Index>(crossings_.size()); ++c) {
      // A loop begins at its first crossing on a column, so that the loop of the crossing above is
      // the part that a hole belongs to, or another hole of it.
      if (crossings_[c].above != kAcross && loop_of_[c] == kNone) follow(c);
    }
  }

  std::vector<Region> parts() const {
    std::vector<Region> result;
    std::vector<Index> part_of(begin_.size());
    for (std::size_t l = 0; l < begin_.size(); ++l) {
      Eigen::Matrix2Xd polygon = corners(begin_[l]);
      if (signed_area(polygon) > 0) {
        part_of[l] = static_cast<Index>(result.size());
        result.push_back({std::move(polygon), {}});
      } else {
        part_of[l] = part_of[loop_of_[crossings_[begin_[l]].above]];
        result[part_of[l]].holes.push_back(std::move(polygon));
      }
    }
    return result;
  }

 private:
  void follow(Index first) {
    Index c = first;
    do {
      loop_of_[c] = static_cast<Index>(begin_.size());
      c = crossings_[c].next;
    } while (c != first);
    begin_.push_back(first);
  }

  Eigen::Matrix2Xd corners(Index first) const {
    std::vector<Eigen::Vector2d> kept;
    Index c = first;
    do {
      const Eigen::Vector2d& at = crossings_[c].at;
      while (kept.size() >= 2 && straight(kept[kept.size() - 2], kept.back(), at)) kept.pop_back();
      if (kept.empty() || kept.back() != at) kept.push_back(at);
      c = crossings_[c].next;
    } while (c != first);
    while (kept.size() > 3 && straight(kept[kept.size() - 2], kept.back(), kept[0])) {
      kept.pop_back();
    }
    const bool turn = !straight(kept.back(), kept[0], kept[1]);
    return Eigen::Map<Eigen::Matrix2Xd>(kept[0].data(), 2, static_cast<Index>(kept.size()))
        .rightCols(static_cast<Index>(kept.size()) - (turn ? 0 : 1));
  }

  static bool straight(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                       const Eigen::Vector2d& c) {
    const Eigen::Vector2d u = b - a, v = c - b;
    return u[0] * v[1] == u[1] * v[0];
  }

  std::vector<Crossing> crossings_;
  std::vector<Index> loop_of_;
  std::vector<Index> begin_;
};

}  // namespace

std::vector<Region> level_set(const Eigen::ArrayXXf& field, float threshold) {
  return Loops(MarchingSquares(field, threshold).run()).parts();
}

}  // namespace deformlab
