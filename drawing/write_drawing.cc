#include "drawing/write_drawing.h"

#include <fmt/format.h>

#include "drawing/formats.h"
#include "drawing/vector/curves.h"
#include "drawing/vector/layers.h"
#include "drawing/vector/svg_names.h"
#include "drawing/vector/write_svg.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/shape/shape_io.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

constexpr double kMostAcross = 4000;  // of a PNG of an SVG, if its size is not asked for [pixel]

double resolution_for(const Drawing& drawing, double asked) {
  constexpr double kAcross = 1000;  // [pixel]
  if (asked > 0) return asked;
  const double longer = drawing.page.sizes().maxCoeff();
  if (drawing.bitmap) return 1;
  return drawing.svg.empty() ? kAcross / longer : std::min(1.0, kMostAcross / longer);
}

/// The mesh with its positions at rest as texture coordinates, which OBJ measures from the lower
/// left corner of the page.
std::string to_obj(const BoundDrawing& drawing, const Eigen::Matrix2Xd& V) {
  const Page& page = drawing.drawing().page;
  const Eigen::Matrix2Xd places =
      page.sizes().cwiseInverse().asDiagonal() * (drawing.rest().V.colwise() - page.min());
  std::string text;
  for (const auto& v : V.colwise()) text += fmt::format("v {:.17g} {:.17g} 0\n", v.x(), v.y());
  for (const auto& p : places.colwise())
    text += fmt::format("vt {:.9g} {:.9g}\n", p.x(), 1 - p.y());
  for (const auto& f : drawing.rest().F.colwise()) {
    text += "f";
    for (const int corner : f) {
      text += fmt::format(" {0}/{0}", corner + 1);
    }
    text += "\n";
  }
  return text;
}

void write_mesh(const fs::path& out, const BoundDrawing& drawing, const Eigen::Matrix2Xd& V) {
  const fs::path& file = drawing.drawing().file;
  const bool same = drawing.drawing().mesh && extension_of(file) == extension_of(out);
  if (!same && extension_of(out) == ".obj") return write_file(out, to_obj(drawing, V));
  Shape shape = same ? read_shape(file) : to_shape(drawing.rest());
  shape.V.topRows<2>() = V;
  write_shape(out, shape, same ? file : fs::path());
}

/// The paths without cuts that the deformation did not need.
std::vector<VectorPath> merged(std::vector<VectorPath> paths, const Page& page) {
  constexpr double kTolerance = 1e-4;  // of the page's diagonal
  const auto merge = [&](Outlines& outlines) {
    for (Curve& curve : outlines.curves) curve = merged(curve, kTolerance * page.diagonal().norm());
  };
  for (VectorPath& path : paths) {
    merge(path.outlines);
    for (Outlines& clip : path.clips) merge(clip);
  }
  return paths;
}

/// Throws InputError if a PNG of the page would be too large. `advice` says what else helps.
void check_size(const fs::path& out, const Page& page, double resolution, const char* advice) {
  const Eigen::Vector2d size = page.sizes() * resolution;
  const std::string problem = size_problem(std::max(1.0, size.x()), std::max(1.0, size.y()));
  if (problem.empty()) return;
  cannot_write(out, fmt::format("it would have {}; {}lower output.resolution (now {:g})", problem,
                                advice, resolution));
}

}  // namespace

double resolution_of(const Drawing& drawing, const DrawingOutputOptions& options) {
  return resolution_for(drawing, options.resolution);
}

Page page_of(const BoundDrawing& drawing, const Eigen::Matrix2Xd& V,
             const DrawingOutputOptions& options) {
  const std::optional<Page> fixed = options.page.fixed(drawing.drawing());
  return fixed ? *fixed : drawing.page_for(V, 1 / resolution_of(drawing.drawing(), options));
}

std::vector<std::string> growth(const Page& from, const Page& to) {
  const Eigen::Vector2d before = from.min() - to.min(), after = to.max() - from.max();
  if (before.isZero() && after.isZero()) return {};
  return {
      fmt::format("the page grew by {:g} to the left, {:g} to the top, {:g} to the right and {:g} "
                  "to the bottom "
                  "to hold the shape; its upper left corner is now at ({:g}, {:g})",
                  before.x(), before.y(), after.x(), after.y(), to.min().x(), to.min().y())};
}

Bitmap picture_of(const fs::path& out, const BoundDrawing& drawing, const Eigen::Matrix2Xd& V,
                  const Eigen::VectorXd& depth, const Page& page,
                  const DrawingOutputOptions& options) {
  const double resolution = resolution_of(drawing.drawing(), options);
  check_size(out, page, resolution, "move the handles less far, set output.page=keep, or ");
  return drawing.picture(V, depth, page, resolution);
}

void check_output(const fs::path& out, const Drawing& drawing,
                  const DrawingOutputOptions& options) {
  const std::string extension = extension_of(out);
  if (extension == ".svg" && drawing.bitmap)
    cannot_write(out, "a bitmap has no curves for an SVG; write .png");
  if (extension == ".svg" && drawing.paths.empty())
    cannot_write(out, fmt::format("the drawing has no curves ({}); write .png",
                                  fmt::join(drawing.not_curves, "; ")));
  if (extension == ".png")
    check_size(out, options.page.fixed(drawing).value_or(drawing.page),
               resolution_for(drawing, options.resolution),
               options.page.box ? "make the box of output.page smaller, or " : "");
  if (is_one_of(kPictureFormats, extension) || is_one_of(kFlatMeshFormats, extension)) return;
  cannot_write(out, fmt::format("unknown extension '{}'; known for drawings: {}", extension,
                                formats_written()));
}

std::vector<std::string> write_drawing(const fs::path& out, const BoundDrawing& drawing,
                                       const Eigen::Matrix2Xd& V, const Eigen::VectorXd& depth,
                                       const DrawingOutputOptions& options) {
  check_options(options);
  check_output(out, drawing.drawing(), options);
  if (!V.allFinite()) cannot_write(out, "a deformed vertex is not finite");
  const std::string extension = extension_of(out);
  if (!is_one_of(kPictureFormats, extension)) {
    write_mesh(out, drawing, V);
    return {};
  }
  const Page page = page_of(drawing, V, options);
  std::vector<std::string> notes;
  if (!options.page.fixed(drawing.drawing())) notes = growth(drawing.drawing().page, page);
  if (extension == ".png") {
    if (options.resolution == 0 && resolution_of(drawing.drawing(), options) < 1)
      notes.push_back(fmt::format(
          "the page of the SVG is larger than {:g} pixels, and the PNG is made smaller; "
          "output.resolution=1 gives it the size of the page",
          kMostAcross));
    write_png(picture_of(out, drawing, V, depth, page, options), out, drawing.drawing().chunks,
              resolution_of(drawing.drawing(), options));
  } else {
    const std::string& svg = drawing.drawing().svg;
    const SvgNames names = svg.empty() ? SvgNames() : SvgNames(svg, drawing.drawing().file);
    notes.insert(notes.end(), names.notes().begin(), names.notes().end());
    if (const std::size_t layers = layers_of(depth); layers > kMostLayers) {
      notes.push_back(fmt::format(
          "the drawing has {} depths, and an SVG shows at most {}: its paths keep the order of the "
          "file where they overlap; write .png, or leave depth.adjust at true",
          layers, kMostLayers));
    }
    write_svg(merged(drawing.paths(V, depth), page), names, page, out);
    for (const std::string& note : drawing.drawing().not_curves)
      notes.push_back(fmt::format("{}; PNG output shows it as the input does", note));
  }
  return notes;
}

}  // namespace deformlab
