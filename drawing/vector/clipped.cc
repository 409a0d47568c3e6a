#include "drawing/vector/clipped.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "drawing/vector/curves.h"

namespace deformlab {
namespace {

using ClipperLib::IntPoint;
constexpr double kNothing = 1e-6;  // of an area

using Key = std::pair<ClipperLib::cInt, ClipperLib::cInt>;

Key key(const IntPoint& p) { return {p.X, p.Y}; }

/// A straight piece of a flattened curve: the cubic that it belongs to, and its parameters.
struct Span {
  int cubic;
  double from, to;
  double begin;  ///< where it begins along its curve [length]
};

/// Curves as polygons, which remember the cubics that they come from.
class Flattened {
 public:
  explicit Flattened(double scale) : scale_(scale) {}

  ClipperLib::Path add(const Curve& curve) {
    ClipperLib::Path path{rounded(curve.points.col(0))};
    double length = 0;
    for (Eigen::Index i = 0; i + 3 < curve.points.cols(); i += 3) {
      const Cubic cubic = curve.points.middleCols<4>(i);
      const int count = count_for(cubic), id = static_cast<int>(cubics_.size());
      cubics_.push_back(cubic);
      Eigen::Vector2d last = cubic.col(0);
      for (int k = 0; k < count; ++k) {
        const double from = k / double(count), to = (k + 1) / double(count);
        const Eigen::Vector2d at = part(cubic, to, to).col(0);
        const IntPoint p = rounded(at);
        if (p != path.back()) {
          spans_.insert({{key(path.back()), key(p)}, {id, from, to, length}});
          path.push_back(p);
        }
        length += (at - last).norm();
        last = at;
      }
    }
    return path;
  }

  /// The span between two neighbouring corners, or nothing if they are not on a curve. It goes
  /// backwards if the corners do.
  const Span* find(const IntPoint& p, const IntPoint& q) const {
    const auto found = spans_.find({key(p), key(q)});
    return found == spans_.end() ? nullptr : &found->second;
  }

  /// The curve through the corners of a polygon.
  Curve curve(const ClipperLib::Path& corners, bool closed) const {
    std::vector<Cubic> cubics;
    std::size_t count = corners.size() - (closed ? 0 : 1);
    for (std::size_t i = 0; i < count;) {
      const auto corner = [&](std::size_t k) { return corners[k % corners.size()]; };
      std::size_t end = i + 1;
      if (const auto run = span(corner(i), corner(end))) {
        double to = run->to;
        for (; end < count; ++end) {
          const auto next = span(corner(end), corner(end + 1));
          if (!next || next->cubic != run->cubic || next->from != to) break;
          to = next->to;
        }
        cubics.push_back(part(cubics_[static_cast<std::size_t>(run->cubic)], run->from, to));
      } else {
        cubics.push_back(line(exact(corner(i)), exact(corner(end))));
      }
      i = end;
    }
    return joined(cubics, closed);
  }

 private:
  IntPoint rounded(const Eigen::Vector2d& p) const {
    return {std::llround(p.x() * scale_), std::llround(p.y() * scale_)};
  }
  Eigen::Vector2d exact(const IntPoint& p) const {
    return {static_cast<double>(p.X) / scale_, static_cast<double>(p.Y) / scale_};
  }

  /// How many straight pieces follow a cubic within about 1000 units of Clipper.
  int count_for(const Cubic& c) const {
    const double bend = std::max((c.col(0) - 2 * c.col(1) + c.col(2)).norm(),
                                 (c.col(1) - 2 * c.col(2) + c.col(3)).norm());
    return std::clamp(static_cast<int>(std::ceil(std::sqrt(bend * scale_ / 1000))), 1, 64);
  }

  std::optional<Span> span(const IntPoint& p, const IntPoint& q) const {
    if (const Span* forward = find(p, q)) return *forward;
    const Span* back = find(q, p);
    if (!back) return std::nullopt;
    return Span{back->cubic, back->to, back->from, back->begin};
  }

  static Cubic line(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    Cubic cubic;
    cubic << a, a + (b - a) / 3, a + (b - a) * 2 / 3, b;
    return cubic;
  }

  static Curve joined(const std::vector<Cubic>& cubics, bool closed) {
    Curve curve{Eigen::Matrix2Xd(2, 3 * std::ssize(cubics) + 1), closed};
    curve.points.col(0) = cubics.front().col(0);
    for (std::size_t k = 0; k < cubics.size(); ++k)
      curve.points.middleCols<3>(3 * static_cast<Eigen::Index>(k) + 1) = cubics[k].rightCols<3>();
    return curve;
  }

  double scale_;
  std::vector<Cubic> cubics_;
  std::map<std::pair<Key, Key>, Span> spans_;
};

double area_of(const ClipperLib::Paths& paths) {
  double area = 0;
  for (const ClipperLib::Path& path : paths) area += ClipperLib::Area(path);
  return std::abs(area);
}

double length_of(const ClipperLib::Path& path) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    length += std::hypot(static_cast<double>(path[i + 1].X - path[i].X),
                         static_cast<double>(path[i + 1].Y - path[i].Y));
  return length;
}

ClipperLib::Paths lines(const ClipperLib::Path& line, const ClipperLib::Paths& region,
                        ClipperLib::ClipType type) {
  ClipperLib::Clipper clipper;
  clipper.PreserveCollinear(true);
  clipper.AddPath(line, ClipperLib::ptSubject, false);
  clipper.AddPaths(region, ClipperLib::ptClip, true);
  ClipperLib::PolyTree tree;
  clipper.Execute(type, tree, ClipperLib::pftEvenOdd, ClipperLib::pftNonZero);
  ClipperLib::Paths open;
  ClipperLib::OpenPathsFromPolyTree(tree, open);
  return open;
}

/// Joins the last part to the first one if the curve is closed and begins inside.
void stitch(ClipperLib::Paths& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (i == j || parts[i].back() != parts[j].front()) continue;
      parts[i].insert(parts[i].end(), parts[j].begin() + 1, parts[j].end());
      parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
      return stitch(parts);
    }
}

ClipperLib::Paths polygons(Flattened& flattened, const Outlines& outlines) {
  ClipperLib::Paths result;
  for (const Curve& curve : outlines.curves) result.push_back(flattened.add(curve));
  return result;
}

ClipperLib::PolyFillType rule_of(const Outlines& outlines) {
  return outlines.even_odd ? ClipperLib::pftEvenOdd : ClipperLib::pftNonZero;
}

/// The part of what is inside the outlines that lies in the region. It is `outlines` itself if
/// nothing lies outside.
Outlines common(Flattened& flattened, const Outlines& outlines, const ClipperLib::Paths& region,
                ClipperLib::PolyFillType region_rule, double nothing) {
  const ClipperLib::Paths all = polygons(flattened, outlines);
  const auto cut = [&](ClipperLib::ClipType type) {
    ClipperLib::Clipper clipper;
    clipper.PreserveCollinear(true);
    clipper.AddPaths(all, ClipperLib::ptSubject, true);
    clipper.AddPaths(region, ClipperLib::ptClip, true);
    ClipperLib::Paths result;
    clipper.Execute(type, result, rule_of(outlines), region_rule);
    return result;
  };
  const ClipperLib::Paths within = cut(ClipperLib::ctIntersection);
  const double outside = area_of(cut(ClipperLib::ctDifference)), area = area_of(within);
  if (outside <= nothing * area) return outlines;
  Outlines result;
  if (area <= nothing * outside) return result;
  for (const ClipperLib::Path& polygon : within)
    if (polygon.size() > 2) result.curves.push_back(flattened.curve(polygon, true));
  return result;
}

}  // namespace

Outlines Clipped::inside(const Outlines& outlines) const {
  Flattened flattened(scale_);
  return common(flattened, outlines, region_, ClipperLib::pftNonZero, nothing_);
}

Clipped region_of(const Outlines& outlines, double scale) {
  Flattened flattened(scale);
  ClipperLib::Paths region;
  ClipperLib::SimplifyPolygons(polygons(flattened, outlines), region, rule_of(outlines));
  return {std::move(region), scale};
}

Outlines common(const Outlines& outlines, const Outlines& clip, double scale) {
  Flattened flattened(scale);
  const ClipperLib::Paths region = polygons(flattened, clip);
  return common(flattened, outlines, region, rule_of(clip), kNothing);
}

std::vector<Clipped::Piece> Clipped::along(const Curve& curve) const {
  Flattened flattened(scale_);
  const ClipperLib::Path line = flattened.add(curve);
  if (line.size() < 2) return {{curve, 0}};
  ClipperLib::Paths parts = lines(line, region_, ClipperLib::ctIntersection);
  double length = 0;
  for (const ClipperLib::Path& path : parts) length += length_of(path);
  if (length >= length_of(line) * (1 - nothing_)) return {{curve, 0}};
  for (ClipperLib::Path& path : parts) {
    int ahead = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      ahead += (flattened.find(path[i], path[i + 1]) ? 1 : 0) -
               (flattened.find(path[i + 1], path[i]) ? 1 : 0);
    if (ahead < 0) std::ranges::reverse(path);
  }
  stitch(parts);
  std::vector<Piece> pieces;
  for (const ClipperLib::Path& path : parts) {
    if (path.size() < 2) continue;
    double before = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const Span* span = flattened.find(path[i], path[i + 1]);
      if (span) {
        before = span->begin - before;
        break;
      }
      before += length_of({path[i], path[i + 1]}) / scale_;
    }
    pieces.push_back({flattened.curve(path, false), std::max(0.0, before)});
  }
  return pieces;
}

}  // namespace deformlab
