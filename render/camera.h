#pragma once

#include <Eigen/Core>

namespace deformlab {

/// The direction and the field of view of a camera. `frame` finds its position.
struct Camera {
  Eigen::Vector3d direction{0.5, 1.0, -0.6};  ///< from the eye into the scene, of any length
  Eigen::Vector3d up{0, 0, 1};                ///< points upward in the picture
  double field_of_view = 30;                  ///< vertical [degrees]
  double margin = 0.05;                       ///< white part of the picture on every side
  bool operator==(const Camera&) const = default;
};

/// A camera with a position. Pictures are computed in framed coordinates: what the view shows lies
/// around the origin, and its bounding box has the diagonal 1. So single precision is enough for
/// any unit and offset.
struct View {
  Eigen::Vector3d center;              ///< of what the view shows [length]
  double size;                         ///< its diagonal, or 1 for a single point [length]
  Eigen::Vector3d eye;                 ///< [framed coordinates]
  Eigen::Vector3d right, up, forward;  ///< orthonormal
  double tan_x, tan_y;                 ///< of half the horizontal and vertical field of view

  /// The unit direction from the eye through the point (s, t) of the picture, where (0, 0) is its
  /// top left corner and (1, 1) its bottom right one.
  Eigen::Vector3f ray(double s, double t) const {
    return (forward + (2 * s - 1) * tan_x * right + (1 - 2 * t) * tan_y * up)
        .normalized()
        .cast<float>();
  }

  Eigen::Matrix3Xd framed(const Eigen::Matrix3Xd& P) const { return (P.colwise() - center) / size; }
};

/// The nearest view that shows all points (3×n) [length] in a picture of the given width and
/// height. Throws InputError if a point is not finite, or if the camera has no direction, looks
/// along its own up, or has a field of view outside (0, 180) or a margin outside [0, 0.5).
View frame(const Eigen::Matrix3Xd& points, const Camera& camera, int width, int height);

}  // namespace deformlab
