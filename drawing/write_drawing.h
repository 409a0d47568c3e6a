#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drawing/bound_drawing.h"

namespace deformlab {

/// How a deformed drawing is written.
struct DrawingOutputOptions {
  /// Pixels of a PNG a unit of length. 0: 1, so those of the drawing; pages of polygons and meshes,
  /// and vector drawings of under 200 or over 4,000 pixels, get 1,000 along the longer side.
  double resolution = 0;
  bool grow = true;  ///< the page grows to hold the shape; else it stays, and what leaves it is cut
  /// Of a rigid shape, OUT.intermediate.obj and OUT.fitted.obj beside OUT: step one's mesh, and the
  /// triangles fitted to it, each for itself (Igarashi et al. 2005, Figure 3).
  bool steps = false;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("resolution", o.resolution, {.min = 0, .max = 1e6},
                "The resolution of a PNG in pixels for each unit of length; 0 keeps that of the "
                "drawing [pixel/length]");
    visit("grow", o.grow,
          "Whether the page grows to hold the shape; otherwise what leaves the page is cut off");
    visit("steps", o.steps,
          "Whether the results of arap_2d's steps are written beside the drawing, as "
          "OUT.intermediate.obj and OUT.fitted.obj");
  }
};

/// Throws InputError where a drawing cannot be written as the extension of `out` says: as
///   .png  any, textures mapped and curves painted;
///   .svg  all but bitmaps: curves stay curves, each painted after those before it, at any depth;
///   .obj .off .ply .stl  the mesh, z = 0 and y down; OBJ with places in the page as texture
///         coordinates. Of a drawing that is a mesh of this format all else stays as in its file.
void check_output(const std::filesystem::path& out, const Drawing& drawing);

/// Writes the drawing with the vertices at V (2×#V), of depth #F or size 0 (see
/// BoundDrawing::picture), whole or not at all. Returns words for the user: how the page grew.
/// Throws InputError as check_output does, where a coordinate is not finite, the page is too large
/// (handles far away), an option is out of range, or the file cannot be written.
std::vector<std::string> write_drawing(const std::filesystem::path& out,
                                       const BoundDrawing& drawing, const Eigen::Matrix2Xd& V,
                                       const Eigen::VectorXd& depth,
                                       const DrawingOutputOptions& options);

}  // namespace deformlab
