#include "drawing/paint.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

#include "drawing/vector/gradient.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

using Pattern = std::unique_ptr<cairo_pattern_t, decltype(&cairo_pattern_destroy)>;
using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

/// The pattern of a single colour, also for a gradient whose frame has collapsed.
Pattern solid(const Paint& paint) {
  const auto& [r, g, b, a] = paint.stops.back().color;
  return {cairo_pattern_create_rgba(r, g, b, a), cairo_pattern_destroy};
}

/// A gradient in its own frame. The pattern's matrix maps the path's coordinates to this frame.
Pattern pattern_of(const Paint& paint) {
  if (paint.kind == Paint::Kind::kColor) return solid(paint);
  const std::optional<GradientFrame> frame = frame_of(paint);
  if (!frame) return solid(paint);
  const Eigen::Vector2d& f = frame->focus;
  Pattern pattern(paint.kind == Paint::Kind::kLinear
                      ? cairo_pattern_create_linear(0, 0, 1, 0)
                      : cairo_pattern_create_radial(f.x(), f.y(), 0, 0, 0, 1),
                  cairo_pattern_destroy);
  for (const auto& [offset, c] : paint.stops)
    cairo_pattern_add_color_stop_rgba(pattern.get(), offset, c[0], c[1], c[2], c[3]);
  cairo_pattern_set_extend(pattern.get(),
                           paint.spread == Paint::Spread::kRepeat    ? CAIRO_EXTEND_REPEAT
                           : paint.spread == Paint::Spread::kReflect ? CAIRO_EXTEND_REFLECT
                                                                     : CAIRO_EXTEND_PAD);
  const Eigen::Affine2d inverse = frame->to_page.inverse();
  const auto& m = inverse.matrix();
  cairo_matrix_t matrix;
  cairo_matrix_init(&matrix, m(0, 0), m(1, 0), m(0, 1), m(1, 1), m(0, 2), m(1, 2));
  cairo_pattern_set_matrix(pattern.get(), &matrix);
  return pattern;
}

void trace_outlines(cairo_t* cairo, const Outlines& outlines) {
  cairo_new_path(cairo);
  for (const Curve& curve : outlines.curves) {
    const Eigen::Matrix2Xd& p = curve.points;
    cairo_move_to(cairo, p(0, 0), p(1, 0));
    for (Eigen::Index i = 1; i + 2 < p.cols(); i += 3)
      cairo_curve_to(cairo, p(0, i), p(1, i), p(0, i + 1), p(1, i + 1), p(0, i + 2), p(1, i + 2));
    if (curve.closed) cairo_close_path(cairo);
  }
  cairo_set_fill_rule(cairo,
                      outlines.even_odd ? CAIRO_FILL_RULE_EVEN_ODD : CAIRO_FILL_RULE_WINDING);
}

void set_line(cairo_t* cairo, const VectorPath& path) {
  using Cap = VectorPath::Cap;
  using Join = VectorPath::Join;
  cairo_set_line_width(cairo, path.stroke_width);
  cairo_set_line_cap(cairo, path.cap == Cap::kRound    ? CAIRO_LINE_CAP_ROUND
                            : path.cap == Cap::kSquare ? CAIRO_LINE_CAP_SQUARE
                                                       : CAIRO_LINE_CAP_BUTT);
  cairo_set_line_join(cairo, path.join == Join::kRound   ? CAIRO_LINE_JOIN_ROUND
                             : path.join == Join::kBevel ? CAIRO_LINE_JOIN_BEVEL
                                                         : CAIRO_LINE_JOIN_MITER);
  cairo_set_miter_limit(cairo, path.miter_limit);
  cairo_set_dash(cairo, path.dashes.data(), static_cast<int>(path.dashes.size()), path.dash_offset);
}

/// Converts Cairo's premultiplied colours to straight ones.
Bitmap to_bitmap(cairo_surface_t* surface, Bitmap bitmap) {
  cairo_surface_flush(surface);
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < bitmap.height; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(data + std::ptrdiff_t{y} * stride);
    for (int x = 0; x < bitmap.width; ++x) {
      const std::uint32_t alpha = row[x] >> 24;
      std::uint8_t* pixel = bitmap.pixel(x, y);
      pixel[3] = static_cast<std::uint8_t>(alpha);
      for (int c = 0; c < 3 && alpha > 0; ++c)
        pixel[c] = static_cast<std::uint8_t>(
            std::min(255U, ((row[x] >> (16 - 8 * c) & 255) * 255 + alpha / 2) / alpha));
    }
  }
  return bitmap;
}

}  // namespace

void paint(cairo_t* cairo, const VectorPath& path) {
  cairo_save(cairo);
  for (const Outlines& clip : path.clips) {
    trace_outlines(cairo, clip);
    cairo_clip(cairo);
  }
  trace_outlines(cairo, path.outlines);
  if (path.fill.kind != Paint::Kind::kNone) {
    cairo_set_source(cairo, pattern_of(path.fill).get());
    cairo_fill_preserve(cairo);
  }
  if (path.stroke.kind != Paint::Kind::kNone && path.stroke_width > 0) {
    set_line(cairo, path);
    cairo_set_source(cairo, pattern_of(path.stroke).get());
    cairo_stroke(cairo);
  }
  cairo_restore(cairo);
}

Bitmap painted(int width, int height, const std::function<void(cairo_t*)>& draw) {
  Bitmap bitmap(width, height);
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height),
                        cairo_surface_destroy);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) throw std::bad_alloc();
  const Context cairo(cairo_create(surface.get()), cairo_destroy);
  draw(cairo.get());
  return to_bitmap(surface.get(), std::move(bitmap));
}

Bitmap rasterized(const std::vector<VectorPath>& paths, const Eigen::AlignedBox2d& page,
                  double resolution) {
  const Eigen::Vector2d size = (page.sizes() * resolution).array().round().max(1);
  const std::string problem = size_problem(size.x(), size.y());
  if (!problem.empty()) throw InputError(fmt::format("cannot paint a page of {}", problem));
  return painted(static_cast<int>(size.x()), static_cast<int>(size.y()), [&](cairo_t* cairo) {
    cairo_scale(cairo, resolution, resolution);
    cairo_translate(cairo, -page.min().x(), -page.min().y());
    for (const VectorPath& path : paths) paint(cairo, path);
  });
}

}  // namespace deformlab
