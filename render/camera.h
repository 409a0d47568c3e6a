#pragma once

#include <Eigen/Core>

namespace deformlab {

/// The direction and the opening of the camera. Its distance follows from what the picture shows.
struct Camera {
  Eigen::Vector3d direction{0.5, 1.0, -0.6};  ///< from the eye into the scene, of any length
  Eigen::Vector3d up{0, 0, 1};                ///< points upward in the picture
  double field_of_view = 30;                  ///< vertical [degrees]
  double margin = 0.05;                       ///< left white on every side, part of the picture
  bool operator==(const Camera&) const = default;
};

/// A camera with a position. Pictures are computed in framed coordinates: what the view frames lies
/// around the origin and has a diagonal of one. So single precision is enough for any unit and
/// offset.
struct View {
  Eigen::Vector3d center;              ///< of what was framed [length]
  double size;                         ///< its diagonal [length], 1 where it is a single point
  Eigen::Vector3d eye;                 ///< framed coordinates
  Eigen::Vector3d right, up, forward;  ///< orthonormal
  double tan_x, tan_y;                 ///< of half the horizontal and vertical field of view

  Eigen::Matrix3Xd framed(const Eigen::Matrix3Xd& P) const { return (P.colwise() - center) / size; }
};

/// The nearest view that shows all of `points` (3×n, [length]) in a picture of the given shape.
/// Throws InputError where a point is not finite or the camera has no direction, looks along its
/// own up, or has a field of view outside (0, 180) or a margin outside [0, 0.5).
View frame(const Eigen::Matrix3Xd& points, const Camera& camera, int width, int height);

}  // namespace deformlab
