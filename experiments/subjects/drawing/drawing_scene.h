#pragma once

#include <filesystem>
#include <string>

#include "drawing/drawing.h"
#include "drawing/formats.h"
#include "experiments/config/config_node.h"
#include "experiments/subjects/drawing/plane_edit.h"

namespace deformlab {

/// The drawing that a config deforms instead of a shape.
struct DrawingSceneOptions {
  std::string file;  ///< beside the config, in the working folder, or packaged clip-art
  DrawingOptions reading;
  TriangulationOptions mesh;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    static const std::string kFiles = fmt::format(
        "An image ({}), a vector drawing (.svg), a polygon (.txt) or a flat mesh ({}): beside the "
        "config, in the working folder, or among openclipart's; without one, the config is about a "
        "shape",
        fmt::join(kImageFormats, " "), fmt::join(kFlatMeshFormats, " "));
    visit("file", o.file, kFiles.c_str());
    DrawingOptions::fields(o.reading, visit);
    TriangulationOptions::fields(o.mesh, visit);
  }
};

/// A drawing, its mesh at rest, and the stiffness of its triangles.
struct DrawingScene {
  std::filesystem::path path;
  Drawing drawing;
  Triangulation rest;                    ///< of its largest part, then of those with handles
  std::vector<Triangulation> following;  ///< of the detached parts that follow `rest`
  /// #F, the stiffness of each triangle (Igarashi et al. 2005, section 5.2)
  Eigen::VectorXd weights;
};

/// Reads and triangulates the drawing of a config in `folder`, whose edit says which detached parts
/// have handles. Throws InputError if it cannot be read or triangulated.
DrawingScene make_drawing(const DrawingSceneOptions& options, const std::filesystem::path& folder,
                          const std::vector<EditEntry>& edit, const CutLines& cuts = {});

/// The lines under `cut:`: a list of lists of points [x, y]. Throws InputError (naming the line of
/// the file) for anything else.
CutLines read_cut_lines(const ConfigNode& list);

/// The levels under `depth.parts`, #V: those of {select: SELECTION, level: n}, else 0. If several
/// entries select a vertex, the last one counts. Throws InputError if an entry selects nothing.
Eigen::VectorXd depth_levels(const ConfigNode& list, const Triangulation& rest);

/// Throws the InputError that depth_levels would throw for the list itself.
void check_depth_levels(const ConfigNode& list);

/// Paints triangles, which gives them another stiffness. An entry {select: SELECTION, weight: w},
/// with the selections of an edit, paints the triangles whose corners are all selected. An entry
/// {mask: FILE.png, weight: w} paints the triangles whose centre lies on a pixel of the mask that
/// is opaque and darker than medium grey. If several entries paint a triangle, the last one counts.
/// Throws InputError if an entry paints nothing, or if its weight is not positive.
void paint(DrawingScene& scene, const ConfigNode& list);

/// Throws the InputError that `paint` would throw for the list itself.
void check_paint(const ConfigNode& list);

}  // namespace deformlab
