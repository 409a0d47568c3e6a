#include "drawing/vector/gradient.h"

#include <Eigen/LU>
#include <cmath>

namespace deformlab {

std::optional<GradientFrame> frame_of(const Paint& paint) {
  constexpr double kCollapsed = 1e-9, kMostFocus = 0.99;
  const Eigen::Matrix2Xd& p = paint.points;
  GradientFrame frame;
  frame.to_page.matrix() << p.col(1) - p.col(0), p.col(2) - p.col(0), p.col(0), 0, 0, 1;
  const Eigen::Matrix2d axes = frame.to_page.linear();
  if (!(std::abs(axes.determinant()) > kCollapsed * axes.squaredNorm())) return std::nullopt;
  if (paint.kind == Paint::Kind::kRadial) {
    frame.focus = axes.inverse() * (p.col(3) - p.col(0));
    // SVG and Cairo differ if the focus is not inside the circle.
    frame.focus *= std::min(1.0, kMostFocus / std::max(frame.focus.norm(), kMostFocus));
  }
  return frame;
}

}  // namespace deformlab
