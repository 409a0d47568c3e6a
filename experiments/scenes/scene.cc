#include "experiments/scenes/scene.h"

#include <glog/logging.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "experiments/scenes/resample.h"
#include "geometry/core/options.h"
#include "geometry/shape/shape_io.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

fs::path find_shape(const std::string& file, const fs::path& folder) {
  for (const fs::path& place :
       {folder / file, fs::path(file), fs::path(DEFORMLAB_SHAPES_DIR) / file}) {
    std::error_code ignored;
    if (fs::exists(place, ignored)) return place;
  }
  throw OptionError(
      "shape.file", "'" + file + "'",
      ", which is neither beside the config, nor in the working folder, nor among the "
      "meshes of libcgal-demo");
}

Shape generated(const ShapeOptions& options) {
  if (options.rod.sides == 0) return make_plane(options);
  return inside_option("rod", [&] { return make_rod(options.rod); });
}

}  // namespace

Shape make_plane(const ShapeOptions& o) {
  check_options(o);
  Shape shape;
  shape.V.resize(3, Eigen::Index{o.columns} * o.rows);
  const double wave = 2 * std::numbers::pi * o.bumps;
  for (int j = 0; j < o.rows; ++j) {
    for (int i = 0; i < o.columns; ++i) {
      const double x = i / (o.columns - 1.0), y = j / (o.rows - 1.0);
      const double z = o.bump_height * std::sin(wave * x) * std::sin(wave * y);
      shape.V.col(Eigen::Index{j} * o.columns + i) << x * o.width, y * o.depth, z;
    }
  }
  for (int j = 0; j + 1 < o.rows; ++j) {
    for (int i = 0; i + 1 < o.columns; ++i) {
      const int a = j * o.columns + i, b = a + o.columns;
      shape.faces.push_back({a, a + 1, b + 1});
      shape.faces.push_back({a, b + 1, b});
    }
  }
  return shape;
}

Shape make_shape(const ShapeOptions& options, const fs::path& folder) {
  std::vector<std::string> notes;
  Shape shape = options.file.empty() ? generated(options)
                                     : read_shape(find_shape(options.file, folder), &notes);
  for (const std::string& note : notes) LOG(WARNING) << note;
  check(shape, "what `shape` describes");
  if (options.vertices != 0) shape = resampled(shape, options.vertices);
  if (options.scan.views != 0) shape = range_scan(shape, options.scan);
  return shape;
}

}  // namespace deformlab
