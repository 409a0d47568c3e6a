#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drawing/bitmap/bitmap.h"
#include "drawing/vector/vector_path.h"
#include "geometry/plane/region.h"
#include "geometry/plane/silhouette.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// The rectangle that a drawing's file or a picture shows [length].
using Page = Eigen::AlignedBox2d;

/// A drawing at rest. Coordinates are those of its file: pixels, x to the right, y down, the first
/// pixel covering [0, 1] × [0, 1]; in polygons and meshes whatever they are there, shown with y
/// down.
struct Drawing {
  std::filesystem::path file;  ///< that it was read from
  Page page;
  std::optional<Bitmap> bitmap;       ///< one pixel a unit, from the page's least corner on
  std::vector<VectorPath> paths;      ///< in the order in which they are painted
  Region region;                      ///< what the drawing covers; empty where `mesh` is given
  std::optional<Triangulation> mesh;  ///< where the file is a mesh
  std::vector<std::string> notes;     ///< what was decided on the way: background, parts left out
};

/// How drawings are read.
struct DrawingOptions {
  TraceOptions trace;       ///< areas in pixels of the drawing
  double background = 0.1;  ///< tolerance for the colour of a plain background, 0 … 1
  int outline = 1200;       ///< pixels along the page's longer side when curves are traced
  double piece = 0.02;      ///< longest piece of a curve, as a part of the page's diagonal

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    TraceOptions::fields(o.trace, visit);
    visit.range("background", o.background, {.min = 0, .max = 1},
                "How far the colours of a plain background may differ, where 1 is the distance of "
                "black and white in one channel");
    visit.range("outline", o.outline, {.min = 16, .max = 10'000},
                "The resolution at which curves are traced, along the page's longer side [pixel]");
    visit.range("piece", o.piece, {.min = 1e-4, .max = 1},
                "The longest piece into which a curve is cut, as a share of the page's diagonal");
  }
};

/// Reads a drawing; the extension tells how, in any case:
///   .png  Its alpha channel, where a pixel is at least half transparent; else its background has
///         to be plain (`remove_background`). The largest part is kept, the rest made transparent.
///   .svg  All that is painted, as cubic curves (`read_svg`); paths wholly outside of the largest
///         part are left out. Curves are cut into pieces, so that long ones can bend.
///   .txt  A closed polygon, a corner `x y` a line; # begins a comment.
///   .obj .off .ply .stl  A flat mesh, which then is the rest shape.
/// Throws InputError where the file cannot be read whole or shows nothing.
Drawing read_drawing(const std::filesystem::path& path, const DrawingOptions& options);

}  // namespace deformlab
