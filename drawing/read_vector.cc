#include "drawing/read_vector.h"

#include <fmt/format.h>

#include <algorithm>

#include "drawing/bitmap/region_pixels.h"
#include "drawing/find_parts.h"
#include "drawing/paint.h"
#include "drawing/vector/curves.h"
#include "drawing/vector/layers.h"
#include "drawing/vector/normalized_svg.h"
#include "drawing/vector/read_svg.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

void close(Outlines& outlines) {
  for (Curve& curve : outlines.curves) curve = closed(std::move(curve));
}

/// Whether the points lie on a line, so that nothing is inside.
bool is_flat(const Curve& curve) {
  const Eigen::Matrix2Xd from_start = curve.points.colwise() - curve.points.col(0);
  Eigen::Index far = 0;
  const double most = from_start.colwise().squaredNorm().maxCoeff(&far);
  const Eigen::Vector2d normal(-from_start(1, far), from_start(0, far));
  return (normal.transpose() * from_start).cwiseAbs().maxCoeff() <= 1e-9 * most;
}

/// The paths with closed outlines where they are filled or clip, so that the line that closes them
/// bends, too. A stroke does not follow this line: it becomes a path of its own. A fill without
/// area, such as that of a stroked line, is left out.
std::vector<VectorPath> with_closed_fills(std::vector<VectorPath> paths) {
  std::vector<VectorPath> result;
  for (VectorPath& path : paths) {
    std::ranges::for_each(path.clips, close);
    const std::vector<Curve>& curves = path.outlines.curves;
    if (std::ranges::all_of(curves, is_flat)) path.fill = {};
    if (is_filled(path) && !std::ranges::all_of(curves, &Curve::closed)) {
      VectorPath fill = path;
      fill.stroke = {};
      close(fill.outlines);
      result.push_back(std::move(fill));
      path.fill = {};
    }
    if (is_filled(path) || is_stroked(path)) result.push_back(std::move(path));
  }
  return result;
}

void cut_pieces(std::vector<Curve>& curves, double longest) {
  for (Curve& curve : curves) curve = cut(curve, longest);
}

/// The pixels of a region [pixel].
class RegionMask {
 public:
  RegionMask(const Region& region, const Bitmap& size)
      : width_(size.width), inside_(size.rgba.size() / 4) {
    for_each_pixel_inside(region, size.width, size.height,
                          [&](int x, int y) { inside_[index(x, y)] = true; });
  }

  /// Whether the pixel at the point, or one beside it, belongs to the region.
  bool near(const Eigen::Vector2d& point) const {
    const int height = static_cast<int>(inside_.size()) / width_;
    const Eigen::Vector2d pixel = point.array().floor();
    for (double y = std::max(0.0, pixel.y() - 1); y <= std::min(height - 1.0, pixel.y() + 1); ++y)
      for (double x = std::max(0.0, pixel.x() - 1); x <= std::min(width_ - 1.0, pixel.x() + 1); ++x)
        if (inside_[index(static_cast<int>(x), static_cast<int>(y))]) return true;
    return false;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_;
  std::vector<bool> inside_;
};

/// Removes the paths that have no point near the region.
void keep_paths(const RegionMask& mask, double resolution, Drawing& drawing) {
  const std::size_t before = drawing.paths.size();
  std::erase_if(drawing.paths, [&](const VectorPath& path) {
    return std::ranges::none_of(path.outlines.curves, [&](const Curve& curve) {
      for (Eigen::Index i = 0; i < curve.points.cols(); i += 3)
        if (mask.near(resolution * curve.points.col(i))) return true;
      return false;
    });
  });
  if (before != drawing.paths.size())
    drawing.notes.push_back(
        fmt::format("left out {} paths that are not on it", before - drawing.paths.size()));
}

void divide(Region& region, double by) {
  region.outline /= by;
  for (Eigen::Matrix2Xd& hole : region.holes) hole /= by;
}

/// Traces the outline of what the paths paint, at the resolution that the options ask for.
void trace_paths(const fs::path& path, const DrawingOptions& options, const CutLines& cuts,
                 Drawing& drawing) {
  const double resolution = options.outline / drawing.page.sizes().maxCoeff();
  Bitmap painted = drawing.not_curves.empty() ? rasterized(drawing.paths, drawing.page, resolution)
                                              : svg_picture(drawing.svg, path, resolution);
  if (find_parts(alpha_of(painted), resolution, false, path, options, cuts, drawing)) {
    keep_paths(RegionMask(drawing.region, painted), resolution, drawing);
    drawing.shows_more = true;
    clear_outside(drawing.region, options.trace.threshold, painted);
  }
  drawing.shown = ShownPixels(painted, resolution);
  divide(drawing.region, resolution);
  for (Region& part : drawing.detached) divide(part, resolution);
}

}  // namespace

Drawing read_vector_drawing(const fs::path& path, const DrawingOptions& options,
                            const CutLines& cuts) {
  Drawing drawing;
  drawing.svg = read_file(path);
  VectorDrawing svg = read_svg(drawing.svg, path);
  drawing.page = {Eigen::Vector2d(0, 0), Eigen::Vector2d(svg.width, svg.height)};
  drawing.notes = std::move(svg.notes);
  drawing.not_curves = std::move(svg.not_curves);
  drawing.paths = cut_along(with_closed_fills(std::move(svg.paths)), cuts, drawing.page);
  if (drawing.paths.empty() && drawing.not_curves.empty())
    cannot_read(path, "it paints nothing on its page");
  const double longest = options.piece * drawing.page.diagonal().norm();
  for (VectorPath& painted : drawing.paths) {
    cut_pieces(painted.outlines.curves, longest);
    for (Outlines& clip : painted.clips) cut_pieces(clip.curves, longest);
  }
  trace_paths(path, options, cuts, drawing);
  return drawing;
}

}  // namespace deformlab
