#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "drawing/binding.h"
#include "drawing/bitmap/background.h"
#include "drawing/bitmap/read_image.h"
#include "drawing/bitmap/region_pixels.h"
#include "drawing/drawing.h"
#include "drawing/paint.h"
#include "drawing/vector/curves.h"
#include "drawing/vector/normalized_svg.h"
#include "drawing/vector/read_svg.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/core/text.h"
#include "geometry/shape/shape_io.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

constexpr std::array<double, 4> kFill{0.87, 0.84, 0.805, 1}, kLine{0.30, 0.45, 0.68, 1};
constexpr double kLineWidth = 0.002, kMargin = 0.02;  // as parts of the page's diagonal

/// Gives the drawing the parts that were found. Returns whether some are dropped.
bool put_parts(Silhouette found, const DrawingOptions& options, Drawing& drawing) {
  drawing.region = std::move(found.region);
  const bool drop = options.parts == DetachedParts::kDrop && !found.detached.empty();
  if (drop) {
    drawing.notes.push_back(
        fmt::format("kept the largest part and left out {} detached from it, {:.2g} % of the area",
                    found.detached.size(), 100 * found.detached_share));
  } else {
    drawing.detached = std::move(found.detached);
  }
  if (found.filled_holes > 0) {
    drawing.notes.push_back(fmt::format("filled {} holes", found.filled_holes));
  }
  return drop;
}

/// The tolerance for the colour of the background, or nothing for `none`.
std::optional<double> background_tolerance(const DrawingOptions& options) {
  if (options.background == "none") return std::nullopt;
  const auto tolerance = to_number(options.background);
  if (!tolerance || !(*tolerance >= 0 && *tolerance <= 1))
    throw InputError(
        fmt::format("drawing.background is '{}'; it must be a number from 0 to 1, or "
                    "none",
                    options.background));
  return tolerance;
}

Region whole(const Bitmap& bitmap) {
  Eigen::Matrix2Xd corners(2, 4);
  corners << 0, bitmap.width, bitmap.width, 0, 0, 0, bitmap.height, bitmap.height;
  return {corners, {}};
}

Drawing read_bitmap(const fs::path& path, const DrawingOptions& options, const CutLines& cuts) {
  const auto tolerance = background_tolerance(options);
  auto [bitmap, chunks] = read_image(path);
  if (bitmap.width < 3 || bitmap.height < 3)
    cannot_read(path, fmt::format("it has {}×{} pixels; a silhouette needs at least 3×3",
                                  bitmap.width, bitmap.height));
  Drawing drawing;
  drawing.chunks = std::move(chunks);
  drawing.page = {Eigen::Vector2d(0, 0), Eigen::Vector2d(bitmap.width, bitmap.height)};
  if (!has_transparency(bitmap)) {
    if (!tolerance && cuts.empty()) {
      drawing.region = checked(whole(bitmap), path.string());
      drawing.bitmap = std::move(bitmap);
      return drawing;
    }
    if (tolerance) drawing.notes.push_back(remove_background(bitmap, *tolerance, path));
  }
  Eigen::ArrayXXf alpha = alpha_of(bitmap);
  cut_along(cuts, 1, alpha);
  if (put_parts(trace(alpha, options.trace, path.string()), options, drawing)) {
    clear_outside(drawing.region, options.trace.threshold, bitmap);
  }
  drawing.bitmap = std::move(bitmap);
  return drawing;
}

void cut_pieces(std::vector<Curve>& curves, double longest) {
  for (Curve& curve : curves) curve = cut(curve, longest);
}

/// The pixels of a region [pixel].
class RegionMask {
 public:
  RegionMask(const Region& region, const Bitmap& size)
      : width_(size.width), inside_(size.rgba.size() / 4) {
    for_each_pixel_inside(region, size.width, size.height,
                          [&](int x, int y) { inside_[index(x, y)] = true; });
  }

  /// Whether the pixel at the point, or one beside it, belongs to the region.
  bool near(const Eigen::Vector2d& point) const {
    const int height = static_cast<int>(inside_.size()) / width_;
    const Eigen::Vector2d pixel = point.array().floor();
    for (double y = std::max(0.0, pixel.y() - 1); y <= std::min(height - 1.0, pixel.y() + 1); ++y)
      for (double x = std::max(0.0, pixel.x() - 1); x <= std::min(width_ - 1.0, pixel.x() + 1); ++x)
        if (inside_[index(static_cast<int>(x), static_cast<int>(y))]) return true;
    return false;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_;
  std::vector<bool> inside_;
};

/// Removes the paths that have no point near the region.
void keep_paths(const RegionMask& mask, double resolution, Drawing& drawing) {
  const std::size_t before = drawing.paths.size();
  std::erase_if(drawing.paths, [&](const VectorPath& path) {
    return std::ranges::none_of(path.outlines.curves, [&](const Curve& curve) {
      for (Eigen::Index i = 0; i < curve.points.cols(); i += 3)
        if (mask.near(resolution * curve.points.col(i))) return true;
      return false;
    });
  });
  if (before != drawing.paths.size())
    drawing.notes.push_back(
        fmt::format("left out {} paths that are not on it", before - drawing.paths.size()));
}

void divide(Region& region, double by) {
  region.outline /= by;
  for (Eigen::Matrix2Xd& hole : region.holes) hole /= by;
}

/// Traces the outline of what the paths paint, at the resolution that the options ask for.
void trace_paths(const fs::path& path, const DrawingOptions& options, const CutLines& cuts,
                 Drawing& drawing) {
  const double resolution = options.outline / drawing.page.sizes().maxCoeff();
  TraceOptions in_pixels = options.trace;
  in_pixels.least_hole *= resolution * resolution;
  const Bitmap painted = drawing.not_curves.empty()
                             ? rasterized(drawing.paths, drawing.page, resolution)
                             : svg_picture(drawing.svg, path, resolution);
  Eigen::ArrayXXf alpha = alpha_of(painted);
  cut_along(cuts, resolution, alpha);
  if (put_parts(trace(alpha, in_pixels, path.string()), options, drawing)) {
    keep_paths(RegionMask(drawing.region, painted), resolution, drawing);
    drawing.shows_more = true;
  }
  divide(drawing.region, resolution);
  for (Region& part : drawing.detached) divide(part, resolution);
}

Drawing read_vector(const fs::path& path, const DrawingOptions& options, const CutLines& cuts) {
  Drawing drawing;
  drawing.svg = read_file(path);
  VectorDrawing svg = read_svg(drawing.svg, path);
  drawing.page = {Eigen::Vector2d(0, 0), Eigen::Vector2d(svg.width, svg.height)};
  drawing.notes = std::move(svg.notes);
  drawing.not_curves = std::move(svg.not_curves);
  drawing.paths = std::move(svg.paths);
  if (drawing.paths.empty() && drawing.not_curves.empty()) cannot_read(path, "it paints nothing");
  const double longest = options.piece * drawing.page.diagonal().norm();
  for (VectorPath& painted : drawing.paths) {
    cut_pieces(painted.outlines.curves, longest);
    for (Outlines& clip : painted.clips) cut_pieces(clip.curves, longest);
  }
  trace_paths(path, options, cuts, drawing);
  return drawing;
}

/// A page around points, for a file that does not define one.
Page page_around(const Eigen::Matrix2Xd& points) {
  Page page(points.rowwise().minCoeff(), points.rowwise().maxCoeff());
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kMargin * page.diagonal().norm());
  return {page.min() - margin, page.max() + margin};
}

VectorPath outlined(Curve curve, const Page& page) {
  VectorPath path;
  path.outlines.curves.push_back(std::move(curve));
  path.fill = one_color(kFill);
  path.stroke = one_color(kLine);
  path.stroke_width = kLineWidth * page.diagonal().norm();
  path.join = VectorPath::Join::kRound;
  return path;
}

Drawing read_polygon(const fs::path& path, const DrawingOptions& options) {
  const std::string bytes = read_file(path);
  std::vector<double> coordinates;
  for (Lines lines(bytes); lines.next();) {
    const auto& words = lines.tokens();
    const auto x = to_number(words.front().text), y = to_number(words.back().text);
    if (words.size() != 2 || !x || !y)
      cannot_read(path,
                  fmt::format("{} must be the two coordinates of a corner, 'x y'", lines.name()));
    coordinates.insert(coordinates.end(), {*x, *y});
  }
  const Eigen::Matrix2Xd corners =
      Eigen::Matrix2Xd::Map(coordinates.data(), 2, std::ssize(coordinates) / 2);
  Drawing drawing;
  drawing.region = checked({corners, {}}, path.string());
  drawing.page = page_around(corners);
  drawing.paths = {
      outlined(cut(polygon(drawing.region.outline), options.piece * drawing.page.diagonal().norm()),
               drawing.page)};
  return drawing;
}

Drawing read_mesh(const fs::path& path) {
  Drawing drawing;
  drawing.mesh = flat(read_shape(path, &drawing.notes), path.string());
  drawing.page = page_around(drawing.mesh->V);
  for (Eigen::Index f = 0; f < drawing.mesh->F.cols(); ++f)
    drawing.paths.push_back(
        outlined(polygon(corners(drawing.mesh->V, drawing.mesh->F, f)), drawing.page));
  return drawing;
}

Drawing read_by_extension(const fs::path& path, const DrawingOptions& options,
                          const CutLines& cuts) {
  const std::string extension = extension_of(path);
  if (is_image(extension)) return read_bitmap(path, options, cuts);
  if (extension == ".svg") return read_vector(path, options, cuts);
  if (!cuts.empty()) {
    throw InputError(
        fmt::format("cannot cut '{}': only images and vector drawings are cut; leave 'cut' out",
                    path.string()));
  }
  if (extension == ".txt") return read_polygon(path, options);
  if (extension == ".obj" || extension == ".off" || extension == ".ply" || extension == ".stl")
    return read_mesh(path);
  const std::string how = extension == ".svgz" ? "unpack it, such as by gunzip, and name it .svg"
                                               : "save it as one of those";
  cannot_read(path, fmt::format("drawings of the format '{}' are not read; known: .png, .jpg, "
                                ".jpeg, .webp, .svg, .txt, .obj, .off, .ply, .stl; {}",
                                extension, how));
}

}  // namespace

Drawing read_drawing(const fs::path& path, const DrawingOptions& options, const CutLines& cuts) {
  check_options(options);
  Drawing drawing = read_by_extension(path, options, cuts);
  drawing.file = path;
  return drawing;
}

bool shows(const Drawing& drawing, const Eigen::Vector2d& point) {
  if (contains(drawing.region, point)) return true;
  if (std::ranges::any_of(drawing.detached,
                          [&](const Region& part) { return contains(part, point); })) {
    return true;
  }
  if (!drawing.bitmap || !drawing.page.contains(point)) return false;
  const int x = std::min(static_cast<int>(point.x()), drawing.bitmap->width - 1);
  const int y = std::min(static_cast<int>(point.y()), drawing.bitmap->height - 1);
  return drawing.bitmap->pixel(x, y)[3] > 0;
}

}  // namespace deformlab
