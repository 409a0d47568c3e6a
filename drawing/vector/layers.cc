#include "drawing/vector/layers.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "drawing/vector/clipped.h"

namespace deformlab {
namespace {

constexpr double kUnits = 1 << 24;     // of Clipper along the drawing's diagonal
constexpr double kStrip = 2e-6;        // half the width of a cut, which is too thin to be seen
constexpr double kNothing = 1e-12;     // of a path, so that the strip of a cut is something
constexpr double kFar = 100;           // diagonals, within which all paths are
constexpr double kUnder = 1.0 / 1000;  // of the diagonal, by which a layer extends under others

ClipperLib::Paths offset(const ClipperLib::Paths& paths, double distance) {
  ClipperLib::ClipperOffset by(2, kUnits / 10'000);
  by.AddPaths(paths, ClipperLib::jtRound, ClipperLib::etClosedPolygon);
  ClipperLib::Paths result;
  by.Execute(result, distance);
  return result;
}

/// The regions of the layers at rest, for the polygons of Clipper.
class Layers {
 public:
  Layers(const Triangulation& rest, const Eigen::VectorXd& depth, double scale, double beyond)
      : rest_(rest), depth_(depth), scale_(scale), beyond_(beyond * scale + kUnits * kUnder) {}

  Clipped region(double depth) const {
    ClipperLib::Clipper clipper;
    const auto own = triangles([&](double d) { return d == depth; });
    const auto front = triangles([&](double d) { return d > depth; });
    const auto behind = triangles([&](double d) { return d < depth; });
    clipper.AddPaths(offset(own, beyond_), ClipperLib::ptSubject, true);
    clipper.AddPaths(offset(front, -kUnits * kUnder), ClipperLib::ptClip, true);
    clipper.AddPaths(behind, ClipperLib::ptClip, true);
    ClipperLib::Paths region;
    clipper.Execute(ClipperLib::ctDifference, region, ClipperLib::pftNonZero,
                    ClipperLib::pftNonZero);
    return {std::move(region), scale_};
  }

 private:
  template <class Takes>
  ClipperLib::Paths triangles(const Takes& takes) const {
    ClipperLib::Clipper clipper;
    for (Eigen::Index f = 0; f < rest_.F.cols(); ++f) {
      if (!takes(depth_[f])) continue;
      ClipperLib::Path corners;
      for (const int v : rest_.F.col(f))
        corners.emplace_back(std::llround(rest_.V(0, v) * scale_),
                             std::llround(rest_.V(1, v) * scale_));
      if (!ClipperLib::Orientation(corners)) ClipperLib::ReversePath(corners);
      clipper.AddPath(corners, ClipperLib::ptSubject, true);
    }
    ClipperLib::Paths merged;
    clipper.Execute(ClipperLib::ctUnion, merged, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    return merged;
  }

  const Triangulation& rest_;
  const Eigen::VectorXd& depth_;
  double scale_, beyond_;
};

/// How far the paths extend beyond the mesh [length].
double reach_beyond(const std::vector<VectorPath>& paths, const Locator& locator) {
  double most = 0;
  for (const VectorPath& path : paths)
    for (const Curve& curve : path.outlines.curves)
      for (const auto& point : curve.points.colwise())
        most = std::max(most, locator(point).distance + path.stroke_width);
  return most;
}

void add_strokes(const VectorPath& path, const Clipped& region, std::vector<VectorPath>& parts) {
  for (const Curve& curve : path.outlines.curves)
    for (const Clipped::Piece& piece : region.along(curve)) {
      VectorPath& part = parts.emplace_back(path);
      part.fill = {};
      part.outlines = {{piece.curve}, false};
      part.dash_offset += piece.begin;
    }
}

bool same(const Outlines& a, const Outlines& b) {
  return a.curves.size() == b.curves.size() &&
         std::equal(a.curves.begin(), a.curves.end(), b.curves.begin(),
                    [](const Curve& p, const Curve& q) {
                      return p.points.cols() == q.points.cols() && p.points == q.points;
                    });
}

/// The paths with their fills cut by their clips, because what a clip hides may be so far from the
/// mesh that the deformation would move it into view. Strokes keep their clips.
std::vector<VectorPath> with_cut_fills(const std::vector<VectorPath>& paths, double scale) {
  std::vector<VectorPath> result;
  for (const VectorPath& path : paths) {
    if (path.clips.empty()) {
      result.push_back(path);
      continue;
    }
    VectorPath fill = path, stroke = path;
    for (const Outlines& clip : path.clips) fill.outlines = common(fill.outlines, clip, scale);
    fill.clips.clear();
    fill.stroke = {};
    stroke.fill = {};
    if (is_filled(path) && !fill.outlines.curves.empty()) result.push_back(std::move(fill));
    if (is_stroked(path)) result.push_back(std::move(stroke));
  }
  return result;
}

/// The parts of the curves that lie inside of the clip.
std::vector<Curve> inside(const std::vector<Curve>& curves, const Outlines& clip, double scale) {
  const Clipped region = region_of(clip, scale);
  std::vector<Curve> result;
  for (const Curve& curve : curves)
    for (Clipped::Piece& piece : region.along(curve)) result.push_back(std::move(piece.curve));
  return result;
}

/// Whether the strokes are those of the whole path.
bool all_strokes(const std::vector<VectorPath>& strokes, const VectorPath& path) {
  if (strokes.size() != path.outlines.curves.size()) return false;
  for (std::size_t i = 0; i < strokes.size(); ++i)
    if (!same(strokes[i].outlines, {{path.outlines.curves[i]}, false})) return false;
  return true;
}

void add_parts(const VectorPath& path, const Clipped& region, std::vector<VectorPath>& parts) {
  VectorPath part = path;
  for (Outlines& clip : part.clips) {
    clip = region.inside(clip);
    if (clip.curves.empty()) return;
  }
  std::vector<VectorPath> strokes;
  if (is_stroked(path)) add_strokes(part, region, strokes);
  if (is_filled(path)) part.outlines = region.inside(path.outlines);
  const bool whole =
      same(part.outlines, path.outlines) && (!is_stroked(path) || all_strokes(strokes, path));
  if (whole) return parts.push_back(std::move(part));
  part.stroke = {};
  if (is_filled(path) && !part.outlines.curves.empty()) parts.push_back(std::move(part));
  for (VectorPath& stroke : strokes) parts.push_back(std::move(stroke));
}

}  // namespace

std::size_t layers_of(const Eigen::VectorXd& depth) {
  return std::set<double>(depth.begin(), depth.end()).size();
}

std::vector<VectorPath> without_hidden(const std::vector<VectorPath>& paths, double diagonal) {
  const double scale = kUnits / diagonal;
  std::vector<VectorPath> result = with_cut_fills(paths, scale);
  for (VectorPath& path : result) {
    for (const Outlines& clip : path.clips)
      path.outlines.curves = inside(path.outlines.curves, clip, scale);
    path.clips.clear();
  }
  return result;
}

std::vector<VectorPath> in_layers(const std::vector<VectorPath>& paths, const Triangulation& rest,
                                  const Locator& locator, const Eigen::VectorXd& depth) {
  const double diagonal = (rest.V.rowwise().maxCoeff() - rest.V.rowwise().minCoeff()).norm();
  const double scale = kUnits / diagonal;
  std::vector<VectorPath> cut = with_cut_fills(paths, scale);
  const std::set<double> depths(depth.begin(), depth.end());
  if (depths.size() < 2 || depths.size() > kMostLayers) return cut;
  const Layers layers(rest, depth, scale, reach_beyond(cut, locator));
  std::vector<VectorPath> parts;
  for (const double d : depths) {
    const Clipped region = layers.region(d);
    for (const VectorPath& path : cut) add_parts(path, region, parts);
  }
  return parts;
}

std::vector<VectorPath> cut_along(const std::vector<VectorPath>& paths,
                                  const std::vector<Eigen::Matrix2Xd>& lines,
                                  const Eigen::AlignedBox2d& page) {
  if (lines.empty()) return paths;
  const double scale = kUnits / page.diagonal().norm();
  ClipperLib::ClipperOffset strips;
  for (const Eigen::Matrix2Xd& line : lines) {
    ClipperLib::Path corners;
    for (const auto& p : line.colwise())
      corners.emplace_back(std::llround(p.x() * scale), std::llround(p.y() * scale));
    strips.AddPath(corners, ClipperLib::jtRound, ClipperLib::etOpenSquare);
  }
  ClipperLib::Paths strip, rest;
  strips.Execute(strip, kUnits * kStrip);
  const auto far = static_cast<ClipperLib::cInt>(kUnits * kFar);
  ClipperLib::Clipper clipper;
  clipper.AddPath({{-far, -far}, {far, -far}, {far, far}, {-far, far}}, ClipperLib::ptSubject,
                  true);
  clipper.AddPaths(strip, ClipperLib::ptClip, true);
  clipper.Execute(ClipperLib::ctDifference, rest, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  const Clipped region(std::move(rest), scale, kNothing);
  std::vector<VectorPath> parts;
  for (const VectorPath& path : paths) add_parts(path, region, parts);
  return parts;
}

}  // namespace deformlab
