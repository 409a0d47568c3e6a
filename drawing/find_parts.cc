#include "drawing/find_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "geometry/core/files.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

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

/// Throws InputError if nothing is opaque enough to be the drawing. `removed` tells whether a
/// background has been removed.
void check_shows(const Eigen::ArrayXXf& alpha, const DrawingOptions& options, bool removed,
                 const fs::path& path) {
  const float most = alpha.maxCoeff();
  if (most >= options.trace.threshold) return;
  if (removed && most == 0)
    cannot_read(
        path,
        fmt::format("it shows nothing: all of it is opaque and like its border, whose colour was "
                    "taken for a background; lower drawing.background (now {}), or "
                    "set drawing.background=none to bend the picture as a rectangle",
                    options.background));
  cannot_read(path, fmt::format("it shows nothing: its greatest opacity is {:g}, and a drawing has "
                                "opaque pixels; drawing.threshold (now {:g}) tells from which "
                                "opacity on a pixel belongs to it",
                                most, options.trace.threshold));
}

}  // namespace

bool find_parts(Eigen::ArrayXXf alpha, double resolution, bool removed, const fs::path& path,
                const DrawingOptions& options, const CutLines& cuts, Drawing& drawing) {
  check_shows(alpha, options, removed, path);
  std::ranges::move(cut_along(cuts, resolution, alpha), std::back_inserter(drawing.notes));
  TraceOptions in_pixels = options.trace;
  in_pixels.least_hole *= resolution * resolution;
  return put_parts(trace(alpha, in_pixels, path.string()), options, drawing);
}

}  // namespace deformlab
