#include "drawing/draw_panel.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "drawing/paint.h"
#include "geometry/core/error.h"
#include "render/color.h"

namespace deformlab {
namespace {

constexpr double kEdgeWidth = 0.8;                     // [pixel]
constexpr double kHandleRadius = 0.014, kSpoke = 2.6;  // part of the width; length in radii
constexpr double kTint = 0.55;                         // opacity of the strongest tint
constexpr double kMargin = 0.04;                       // as a part of the frame's diagonal

void check(const BoundDrawing& drawing, const DrawingPanel& panel) {
  const auto require = [](bool good, const std::string& what) {
    if (!good) throw InputError(fmt::format("cannot draw a panel: {}", what));
  };
  const Eigen::Index n = drawing.rest().V.cols(), m = drawing.rest().F.cols();
  const Eigen::Index p = panel.handles.cols();
  const auto fits = [](Eigen::Index size, Eigen::Index all) { return size == 0 || size == all; };
  require(panel.V.cols() == n, fmt::format("{} vertices instead of {}", panel.V.cols(), n));
  require(
      fits(panel.depth.size(), m) && fits(panel.tint.size(), m) && fits(panel.loose.cols(), 3 * m),
      "depth, tint or loose triangles are not one for each triangle");
  require(fits(panel.angles.size(), p) && fits(panel.targets.cols(), p),
          "angles or targets are not one for each handle");
  require(panel.V.allFinite() && panel.loose.allFinite() && panel.handles.allFinite() &&
              panel.targets.allFinite() && panel.tint.allFinite() && panel.depth.allFinite(),
          "a coordinate is not finite");
}

/// Draws in the frame's coordinates, with widths in pixels.
class Pencil {
 public:
  Pencil(cairo_t* cairo, const Page& frame, double scale)
      : cairo_(cairo), origin_(frame.min()), scale_(scale) {
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  }

  void color(const Color& c, double alpha = 1) {
    cairo_set_source_rgba(cairo_, c[0], c[1], c[2], alpha);
  }

  void triangle(const Eigen::Matrix<double, 2, 3>& corners) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d p = pixel(corners.col(i));
      i == 0 ? cairo_move_to(cairo_, p.x(), p.y()) : cairo_line_to(cairo_, p.x(), p.y());
    }
    cairo_close_path(cairo_);
  }

  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width) {
    const Eigen::Vector2d p = pixel(a), q = pixel(b);
    cairo_move_to(cairo_, p.x(), p.y());
    cairo_line_to(cairo_, q.x(), q.y());
    stroke(width);
  }

  /// Draws a filled dot with a dark rim. `radius` is in pixels.
  void dot(const Eigen::Vector2d& center, double radius, const Color& c) {
    const Eigen::Vector2d p = pixel(center);
    cairo_new_path(cairo_);
    cairo_arc(cairo_, p.x(), p.y(), radius, 0, 2 * M_PI);
    color(c);
    cairo_fill_preserve(cairo_);
    color(Color(0.1, 0.1, 0.12));
    stroke(radius / 5);
  }

  void stroke(double width) {
    cairo_set_line_width(cairo_, width);
    cairo_stroke(cairo_);
  }

  void fill() { cairo_fill_preserve(cairo_); }
  void forget() { cairo_new_path(cairo_); }
  double scale() const { return scale_; }

 private:
  Eigen::Vector2d pixel(const Eigen::Vector2d& p) const { return (p - origin_) * scale_; }

  cairo_t* cairo_;
  Eigen::Vector2d origin_;
  double scale_;
};

/// The corners of all triangles, three columns for each.
Eigen::Matrix2Xd corners_of(const BoundDrawing& drawing, const DrawingPanel& panel) {
  if (panel.loose.cols() > 0) return panel.loose;
  const Eigen::Matrix3Xi& F = drawing.rest().F;
  Eigen::Matrix2Xd all(2, 3 * F.cols());
  for (Eigen::Index f = 0; f < F.cols(); ++f) all.middleCols<3>(3 * f) = corners(panel.V, F, f);
  return all;
}

/// The triangles from the farthest to the nearest. Those of equal depth keep their order.
std::vector<Eigen::Index> back_to_front(const Eigen::VectorXd& depth, Eigen::Index count) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  if (depth.size() > 0)
    std::ranges::stable_sort(order, {}, [&](Eigen::Index f) { return depth[f]; });
  return order;
}

void draw_triangles(Pencil& pencil, const BoundDrawing& drawing, const DrawingPanel& panel) {
  const bool plain = !panel.drawing || panel.loose.cols() > 0;
  const Eigen::Matrix2Xd all = corners_of(drawing, panel);
  for (const Eigen::Index f : back_to_front(panel.depth, all.cols() / 3)) {
    pencil.triangle(all.middleCols<3>(3 * f));
    if (plain) {
      pencil.color(colors::kSurface);
      pencil.fill();
    }
    if (panel.tint.size() > 0 && panel.tint[f] > 0) {
      pencil.color(colors::kTarget, kTint * std::min(1.0, panel.tint[f]));
      pencil.fill();
    }
    pencil.color(colors::kEdge, plain ? 1 : 0.6);
    plain || panel.edges ? pencil.stroke(kEdgeWidth) : pencil.forget();
  }
}

void draw_handles(Pencil& pencil, const DrawingPanel& panel, double radius) {
  for (Eigen::Index i = 0; i < panel.targets.cols(); ++i) {
    pencil.color(colors::kTarget);
    pencil.line(panel.handles.col(i), panel.targets.col(i), radius / 3);
    pencil.dot(panel.targets.col(i), 0.7 * radius, colors::kTarget);
  }
  for (Eigen::Index i = 0; i < panel.handles.cols(); ++i) {
    const Eigen::Vector2d at = panel.handles.col(i);
    if (panel.angles.size() > 0 && std::isfinite(panel.angles[i])) {
      const Eigen::Vector2d way(std::cos(panel.angles[i]), std::sin(panel.angles[i]));
      pencil.color(Color(0.1, 0.1, 0.12));
      pencil.line(at, at + way * (kSpoke * radius / pencil.scale()), radius / 2.5);
    }
    pencil.dot(at, radius, colors::kHandle);
  }
}

void lay_over(const Bitmap& layer, Image& image) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = layer.pixel(x, y);
      std::uint8_t* q = image.pixel(x, y);
      for (int c = 0; c < 3; ++c)
        q[c] = static_cast<std::uint8_t>((p[c] * p[3] + q[c] * (255 - p[3]) + 127) / 255);
    }
}

}  // namespace

Page frame_of(const BoundDrawing& drawing, const std::vector<DrawingPanel>& panels) {
  Page frame;
  for (const DrawingPanel& panel : panels) {
    check(drawing, panel);
    for (const Eigen::Matrix2Xd* points : {&panel.V, &panel.loose, &panel.handles, &panel.targets})
      for (const auto& point : points->colwise()) frame.extend(Eigen::Vector2d(point));
  }
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kMargin * frame.diagonal().norm());
  return {frame.min() - margin, frame.max() + margin};
}

Image draw_panel(const BoundDrawing& drawing, const DrawingPanel& panel, const Page& frame,
                 int width) {
  check(drawing, panel);
  const double scale = width / frame.sizes().x();
  const double height = std::max(1.0, std::round(frame.sizes().y() * scale));
  const std::string problem = size_problem(width, height);
  if (!problem.empty()) throw InputError(fmt::format("cannot draw a panel of {}", problem));
  Image image(width, static_cast<int>(height));
  if (panel.drawing && panel.loose.cols() == 0)
    lay_over(drawing.picture(panel.V, panel.depth, frame, scale), image);
  lay_over(painted(image.width, image.height,
                   [&](cairo_t* cairo) {
                     Pencil pencil(cairo, frame, scale);
                     draw_triangles(pencil, drawing, panel);
                     draw_handles(pencil, panel, std::max(3.0, kHandleRadius * width));
                   }),
           image);
  return with_caption(image, panel.caption);
}

}  // namespace deformlab
