#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "drawing/vector/vector_path.h"

namespace deformlab {

/// The affine frame in which a linear gradient goes from (0, 0) to (1, 0), and a radial one fills
/// the unit circle.
struct GradientFrame {
  Eigen::Affine2d to_page;
  Eigen::Vector2d focus{0, 0};  ///< in the frame, inside the unit circle
};

/// The frame of a gradient, or nothing if it has collapsed to a line or a point.
std::optional<GradientFrame> frame_of(const Paint& paint);

}  // namespace deformlab
