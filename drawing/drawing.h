#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drawing/bitmap/bitmap.h"
#include "drawing/bitmap/cut_lines.h"
#include "drawing/vector/vector_path.h"
#include "geometry/plane/region.h"
#include "geometry/plane/silhouette.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// The rectangle that a drawing's file or a picture shows [length].
using Page = Eigen::AlignedBox2d;

/// Which pixels of a picture are not wholly transparent.
class ShownPixels {
 public:
  ShownPixels() = default;
  /// `resolution` is that of the picture [pixel/length].
  ShownPixels(const Bitmap& picture, double resolution);
  /// Whether the point lies on such a pixel [length].
  bool operator()(const Eigen::Vector2d& point) const;

 private:
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> shown_;  ///< height × width
  double resolution_ = 1;
};

/// A drawing at rest. Its coordinates are those of its file, with x to the right and y down. The
/// unit of a bitmap or vector drawing is a pixel, and the first pixel covers [0, 1] × [0, 1].
struct Drawing {
  std::filesystem::path file;  ///< the file that it was read from
  Page page;
  std::optional<Bitmap> bitmap;         ///< the pixels of the page, if the file is a bitmap
  std::string chunks;                   ///< of a PNG, which its pictures keep (kept_chunks)
  std::string svg;                      ///< the bytes of an SVG whose picture is shown
  ShownPixels shown;                    ///< what that picture shows of its parts
  bool shows_more = false;              ///< whether the SVG shows detached parts that are left out
  CutLines cuts;                        ///< along which it has been cut
  std::vector<VectorPath> paths;        ///< in the order in which they are painted
  Region region;                        ///< its largest connected part; empty if there is a mesh
  std::vector<Region> detached;         ///< the parts that are apart from it, larger ones first
  std::optional<Triangulation> mesh;    ///< the mesh, if the file is one
  std::vector<std::string> notes;       ///< what the user should know, such as parts left out
  std::vector<std::string> not_curves;  ///< what an SVG of the paths does not show
};

/// What becomes of the parts of a drawing that are apart from the largest one: they follow what is
/// nearest to them, get meshes of their own, or are left out.
enum class DetachedParts { kBind, kOwn, kDrop };
constexpr auto names_of(DetachedParts) {
  using enum DetachedParts;
  return std::to_array<EnumName<DetachedParts>>({{kBind, "bind"}, {kOwn, "own"}, {kDrop, "drop"}});
}

/// How drawings are read.
struct DrawingOptions {
  TraceOptions trace;  ///< areas are in pixels of the drawing
  DetachedParts parts = DetachedParts::kBind;
  /// Tolerance for the colour of a plain background, 0 … 1, or `none`: an opaque picture is all
  /// drawing.
  std::string background = "0.1";
  int outline = 1200;   ///< along the page's longer side, when curves are traced [pixel]
  double piece = 0.02;  ///< longest piece of a curve, as a part of the page's diagonal

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    TraceOptions::fields(o.trace, visit);
    visit("parts", o.parts,
          "What becomes of the parts that are detached from the largest one: they follow what is "
          "nearest to them as if they were attached (bind), get meshes of their own (own), or are "
          "left out (drop); with bind, a part with a handle gets a mesh of its own");
    visit("background", o.background,
          "How far the colours of a plain background may differ, from 0 to 1, where 1 is the "
          "distance of black and white in one channel; or none, for an opaque picture that is all "
          "drawing, such as a photograph");
    visit.range("outline", o.outline, {.min = 16, .max = 10'000},
                "The resolution at which curves are traced, along the page's longer side [pixel]");
    visit.range("piece", o.piece, {.min = 1e-4, .max = 1},
                "The longest piece into which a curve is cut, as a share of the page's diagonal");
  }
};

/// Reads a drawing. Its extension, in upper or lower case, says what it is:
///   .png .jpg .jpeg .webp  A bitmap. Its alpha channel shows the drawing if a pixel is at least
///         half transparent. Otherwise its background has to be plain (`remove_background`), or
///         `background` is none and the drawing is the whole page.
///   .svg  A vector drawing, which becomes cubic curves (`read_svg`). Curves are cut into pieces,
///   so
///         that long ones can bend.
///   .txt  A closed polygon with a corner `x y` on each line. # begins a comment.
///   .obj .off .ply .stl  A flat mesh, which becomes the rest shape.
/// If detached parts are dropped, their pixels become transparent, and the paths outside of the
/// largest part are left out. `cuts` are lines along which the region of an image or a vector
/// drawing is cut, so that what touches there comes apart. Throws InputError if the file cannot be
/// read completely or shows nothing, and for cuts through another kind of drawing.
Drawing read_drawing(const std::filesystem::path& path, const DrawingOptions& options,
                     const CutLines& cuts = {});

/// Whether a point belongs to the drawing: it lies in a part of it or on a pixel that is not wholly
/// transparent.
bool shows(const Drawing& drawing, const Eigen::Vector2d& point);

}  // namespace deformlab
