#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "drawing/binding.h"
#include "drawing/bitmap/background.h"
#include "drawing/bitmap/read_image.h"
#include "drawing/bitmap/region_pixels.h"
#include "drawing/drawing.h"
#include "drawing/find_parts.h"
#include "drawing/formats.h"
#include "drawing/read_vector.h"
#include "drawing/vector/curves.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/core/text.h"
#include "geometry/shape/shape_io.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

constexpr std::array<double, 4> kFill{0.87, 0.84, 0.805, 1}, kLine{0.30, 0.45, 0.68, 1};
constexpr double kLineWidth = 0.002, kMargin = 0.02;  // as parts of the page's diagonal

/// A line that is not understood, for messages.
std::string quoted_line(const std::vector<Token>& words) {
  std::string text;
  for (const Token& word : words) text += (text.empty() ? "" : " ") + std::string(word.text);
  return quoted_ascii(text);
}

/// The tolerance for the colour of the background, or nothing for `none`.
std::optional<double> background_tolerance(const DrawingOptions& options) {
  if (options.background == "none") return std::nullopt;
  const auto tolerance = to_number(options.background);
  if (!tolerance || !(*tolerance >= 0 && *tolerance <= 1))
    throw OptionError("drawing.background", fmt::format("'{}'", options.background),
                      "; allowed: a number from 0 to 1, or none");
  return tolerance;
}

Region whole(const Bitmap& bitmap) {
  Eigen::Matrix2Xd corners(2, 4);
  corners << 0, bitmap.width, bitmap.width, 0, 0, 0, bitmap.height, bitmap.height;
  return {corners, {}};
}

Drawing read_bitmap(const fs::path& path, const DrawingOptions& options, const CutLines& cuts) {
  const auto tolerance = background_tolerance(options);
  auto [bitmap, chunks, notes] = read_image(path);
  if (bitmap.width < 3 || bitmap.height < 3)
    cannot_read(path, fmt::format("it has {}×{} pixels; a silhouette needs at least 3×3",
                                  bitmap.width, bitmap.height));
  Drawing drawing;
  drawing.chunks = std::move(chunks);
  drawing.notes = std::move(notes);
  drawing.page = {Eigen::Vector2d(0, 0), Eigen::Vector2d(bitmap.width, bitmap.height)};
  const bool removes = !has_transparency(bitmap) && tolerance;
  if (!has_transparency(bitmap)) {
    if (!tolerance && cuts.empty()) {
      drawing.region = checked(whole(bitmap), path.string());
      drawing.bitmap = std::move(bitmap);
      return drawing;
    }
    if (tolerance) drawing.notes.push_back(remove_background(bitmap, *tolerance, path));
  }
  if (find_parts(alpha_of(bitmap), 1, removes, path, options, cuts, drawing)) {
    clear_outside(drawing.region, options.trace.threshold, bitmap);
  }
  drawing.bitmap = std::move(bitmap);
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
      cannot_read(path, fmt::format("{} must be the two coordinates of a corner, 'x y'; found {}",
                                    lines.name(), quoted_line(words)));
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
  if (is_one_of(kImageFormats, extension)) return read_bitmap(path, options, cuts);
  if (extension == ".svg") return read_vector_drawing(path, options, cuts);
  if (!cuts.empty()) {
    throw InputError(
        fmt::format("cannot cut '{}': only images and vector drawings are cut; leave 'cut' out",
                    path.string()));
  }
  if (extension == ".txt") return read_polygon(path, options);
  if (is_one_of(kFlatMeshFormats, extension)) return read_mesh(path);
  const std::string how = extension == ".svgz" ? "unpack it, such as by gunzip, and name it .svg"
                                               : "save it as one of those";
  cannot_read(path, fmt::format("drawings of the format '{}' are not read; known: {}; {}",
                                extension, formats_read(), how));
}

}  // namespace

Drawing read_drawing(const fs::path& path, const DrawingOptions& options, const CutLines& cuts) {
  check_options(options);
  Drawing drawing = read_by_extension(path, options, cuts);
  drawing.file = path;
  drawing.cuts = cuts;
  return drawing;
}

ShownPixels::ShownPixels(const Bitmap& picture, double resolution)
    : shown_(alpha_of(picture) > 0), resolution_(resolution) {}

bool ShownPixels::operator()(const Eigen::Vector2d& point) const {
  const Eigen::Array2d pixel = (point.array() * resolution_).floor();
  if ((pixel < 0).any() || pixel.x() >= double(shown_.cols()) || pixel.y() >= double(shown_.rows()))
    return false;
  return shown_(static_cast<Eigen::Index>(pixel.y()), static_cast<Eigen::Index>(pixel.x()));
}

bool shows(const Drawing& drawing, const Eigen::Vector2d& point) {
  if (contains(drawing.region, point)) return true;
  if (std::ranges::any_of(drawing.detached,
                          [&](const Region& part) { return contains(part, point); })) {
    return true;
  }
  if (!drawing.bitmap) return drawing.shown(point);
  if (!drawing.page.contains(point)) return false;
  const int x = std::min(static_cast<int>(point.x()), drawing.bitmap->width - 1);
  const int y = std::min(static_cast<int>(point.y()), drawing.bitmap->height - 1);
  return drawing.bitmap->pixel(x, y)[3] > 0;
}

}  // namespace deformlab
