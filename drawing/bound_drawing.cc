#include "drawing/bound_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drawing/bitmap/region_pixels.h"
#include "drawing/paint.h"
#include "drawing/vector/layers.h"
#include "drawing/vector/normalized_svg.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr double kTouching = 1e-6;  // a part that leaves the page by fewer steps counts as inside

/// The mesh in the coordinates of a picture of the page [pixel].
Triangulation in_pixels(const Triangulation& mesh, const Page& page, double resolution) {
  return {(mesh.V.colwise() - page.min()) * resolution, mesh.F};
}

/// Adds the columns of `moved` whose position at rest is on the page.
void extend(const Eigen::Matrix2Xd& rest, const Eigen::Matrix2Xd& moved, const Page& page,
            Page& reach) {
  for (Eigen::Index i = 0; i < rest.cols(); ++i)
    if (page.contains(Eigen::Vector2d(rest.col(i)))) reach.extend(Eigen::Vector2d(moved.col(i)));
}

}  // namespace

BoundDrawing::BoundDrawing(Drawing drawing, Triangulation rest, std::vector<Triangulation> parts)
    : drawing_(std::move(drawing)),
      rest_(std::move(rest)),
      parts_(rest_, std::move(parts)),
      shown_(without_hidden(drawing_.paths, drawing_.page.diagonal().norm()), parts_.all(),
             Locator(parts_.all()), drawing_.cuts) {
  if (drawing_.bitmap)
    texture_.emplace(*drawing_.bitmap, in_pixels(parts_.all(), drawing_.page, 1));
}

std::vector<VectorPath> BoundDrawing::paths(const Eigen::Matrix2Xd& V,
                                            const Eigen::VectorXd& depth) const {
  const Triangulation& all = parts_.all();
  const Locator locator(all);
  return BoundPaths(in_layers(drawing_.paths, all, locator, parts_.depths(depth)), all, locator,
                    drawing_.cuts)(parts_(V));
}

Bitmap BoundDrawing::picture(const Eigen::Matrix2Xd& V, const Eigen::VectorXd& depth,
                             const Page& page, double resolution) const {
  const Eigen::Vector2d size = (page.sizes() * resolution).array().round().max(1);
  const std::string problem = size_problem(size.x(), size.y());
  if (!problem.empty()) throw InputError(fmt::format("cannot draw a page of {}", problem));
  if (!texture_ && drawing_.svg.empty() && depth.size() == 0) {
    return rasterized(shown_(parts_(V)), page, resolution);
  }
  const double texels = texture_ ? 1 : resolution;  // for each unit of length
  const Eigen::Matrix2Xd at = (parts_(V).colwise() - drawing_.page.min()) * texels;
  const TextureView view{.width = static_cast<int>(size.x()),
                         .height = static_cast<int>(size.y()),
                         .origin = (page.min() - drawing_.page.min()) * texels,
                         .scale = resolution / texels};
  if (texture_) return texture_->draw(at, parts_.depths(depth), view);
  return TextureMap(at_rest(resolution), in_pixels(parts_.all(), drawing_.page, resolution))
      .draw(at, parts_.depths(depth), view);
}

Bitmap BoundDrawing::at_rest(double resolution) const {
  if (drawing_.svg.empty()) return rasterized(drawing_.paths, drawing_.page, resolution);
  Bitmap bitmap = svg_picture(drawing_.svg, drawing_.file, resolution);
  if (drawing_.shows_more) {
    Region region = drawing_.region;
    region.outline *= resolution;
    for (Eigen::Matrix2Xd& hole : region.holes) hole *= resolution;
    clear_outside(region, TraceOptions().threshold, bitmap);
  }
  return bitmap;
}

Page BoundDrawing::page_for(const Eigen::Matrix2Xd& V, double step) const {
  if (!V.allFinite()) throw InputError("cannot draw: a deformed vertex is not finite");
  const Page& page = drawing_.page;
  Page reach;
  const Eigen::Matrix2Xd moved_mesh = parts_(V);
  extend(parts_.all().V, moved_mesh, page, reach);
  double beyond = 1;  // strokes and pixels extend beyond control points by this number of steps
  const std::vector<VectorPath> moved = shown_(moved_mesh);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    beyond = std::max(beyond, 1 + moved[i].stroke_width / step / 2);
    for (std::size_t c = 0; c < moved[i].outlines.curves.size(); ++c)
      extend(shown_.rest()[i].outlines.curves[c].points, moved[i].outlines.curves[c].points, page,
             reach);
  }
  if (texture_)
    extend(texture_->square_corners_at_rest(), texture_->square_corners(moved_mesh), page, reach);
  const auto grown = [&](const Eigen::Vector2d& by) -> Eigen::Vector2d {
    return (by.array() > kTouching * step).select((by.array() / step + beyond).ceil() * step, 0.0);
  };
  return {page.min() - grown(page.min() - reach.min()),
          page.max() + grown(reach.max() - page.max())};
}

}  // namespace deformlab
