#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drawing/bound_drawing.h"

namespace deformlab {

/// The page of a picture of a deformed drawing: that of the drawing at rest, enlarged where the
/// shape leaves it (BoundDrawing::page_for), or as it is.
enum class PageRule { kGrow, kKeep };
constexpr auto names_of(PageRule) {
  using enum PageRule;
  return std::to_array<EnumName<PageRule>>({{kGrow, "grow"}, {kKeep, "keep"}});
}

/// How the page of a picture is chosen.
struct OutputPage {
  PageRule rule = PageRule::kGrow;
  std::optional<Page> box;  ///< the page instead of that of the rule, with an extent [length]

  /// The page if it does not depend on the deformation, else nothing.
  std::optional<Page> fixed(const Drawing& drawing) const {
    return !box && rule == PageRule::kKeep ? drawing.page : box;
  }
};

/// How a deformed drawing is written.
struct DrawingOutputOptions {
  /// Resolution of a PNG [pixel/length]. 0 keeps the pixels of an image or of an SVG's page, of
  /// which it gets 4,000 at most along the longer side. Polygons and meshes, which have none, get
  /// 1,000.
  double resolution = 0;
  OutputPage page;
  /// Whether the results of arap_2d's steps are written beside OUT: the mesh of step one as
  /// OUT.intermediate.obj, and the triangles that are fitted to it, each by itself, as
  /// OUT.fitted.obj (Igarashi et al. 2005, Figure 3).
  bool steps = false;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range(
        "resolution", o.resolution, {.min = 0, .max = 1e6},
        "The resolution of a PNG in pixels for each unit of length; 0 keeps that of an image "
        "or an SVG, with at most 4000 pixels along the longer side of an SVG, and gives polygons "
        "and meshes 1000 [pixel/length]");
    visit("page", o.page,
          "The page of a PNG or an SVG, and of the panels of a picture: that of the drawing, which "
          "grows where the shape leaves it (grow); always that of the drawing, so that what leaves "
          "it is cut off (keep); or a box [x0, y0, x1, y1] of positions in the drawing, for "
          "pictures that belong together [pixel]");
    visit("steps", o.steps,
          "Whether the results of arap_2d's steps are written beside the drawing, as "
          "OUT.intermediate.obj and OUT.fitted.obj");
  }
};

/// The resolution of a picture of the drawing [pixel/length].
double resolution_of(const Drawing& drawing, const DrawingOutputOptions& options);

/// The page that a picture shows with the vertices at V (2×#V) [length]. Throws InputError if a
/// coordinate is not finite.
Page page_of(const BoundDrawing& drawing, const Eigen::Matrix2Xd& V,
             const DrawingOutputOptions& options);

/// A note for the user of how much the page grew on each side, or nothing.
std::vector<std::string> growth(const Page& from, const Page& to);

/// The PNG's pixels: the picture of the page. Throws InputError (naming `out`) if it is too large.
Bitmap picture_of(const std::filesystem::path& out, const BoundDrawing& drawing,
                  const Eigen::Matrix2Xd& V, const Eigen::VectorXd& depth, const Page& page,
                  const DrawingOutputOptions& options);

/// Throws InputError if a drawing cannot be written with the extension of `out`:
///   .png  Any drawing can be written.
///   .svg  All drawings but bitmaps. Curves stay curves, and are in front where their triangles
///   are. .obj .off .ply .stl  The mesh of any drawing, with z = 0 and y down. In OBJ, texture
///         coordinates are the positions at rest in the page. A drawing that was read from a mesh
///         of the same format keeps all else of its file.
/// It also throws if a PNG would be too large even if its page does not grow.
void check_output(const std::filesystem::path& out, const Drawing& drawing,
                  const DrawingOutputOptions& options);

/// Writes the drawing with the vertices at V (2×#V). `depth` is that of BoundDrawing::picture. The
/// file is complete, or there is none. Returns notes for the user about how the page grew. Throws
/// InputError as check_output does, and if a coordinate is not finite, the page is too large, an
/// option is out of range, or the file cannot be written.
std::vector<std::string> write_drawing(const std::filesystem::path& out,
                                       const BoundDrawing& drawing, const Eigen::Matrix2Xd& V,
                                       const Eigen::VectorXd& depth,
                                       const DrawingOutputOptions& options);

}  // namespace deformlab
