#pragma once

#include <filesystem>
#include <string>

#include "experiments/scenes/range_scan.h"
#include "experiments/scenes/rod.h"
#include "geometry/shape/shape.h"

namespace deformlab {

/// Where the shape of a config comes from: a file, or a generated plane or rod.
struct ShapeOptions {
  std::string file;        ///< beside the config, in the working folder, or a packaged mesh
  int columns = 201;       ///< columns of vertices of the generated plane, along x
  int rows = 201;          ///< rows of vertices, along y
  double width = 1;        ///< [length]
  double depth = 1;        ///< [length]
  int bumps = 0;           ///< periods of z = bump_height sin sin along each side
  double bump_height = 0;  ///< [length]
  RodOptions rod;          ///< takes the place of the plane
  int vertices = 0;        ///< the mesh is subdivided or simplified to this number; 0: it is not
  RangeScanOptions scan;   ///< replaces the shape by scans of it

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("file", o.file,
          "A file with a shape: beside the config, in the working folder, or among the meshes of "
          "libcgal-demo; without one, a plane is generated from the options below");
    visit.range("columns", o.columns, {.min = 2, .max = 4000},
                "The number of vertices of the plane along x");
    visit.range("rows", o.rows, {.min = 2, .max = 4000},
                "The number of vertices of the plane along y");
    visit.range("width", o.width, {.min = 0, .exclusive_min = true},
                "The extent of the plane along x [length]");
    visit.range("depth", o.depth, {.min = 0, .exclusive_min = true},
                "The extent of the plane along y [length]");
    visit("bumps", o.bumps, "The number of periods of the plane's bumps along each side");
    visit("bump_height", o.bump_height, "The amplitude of the bumps along z [length]");
    visit("rod", o.rod, "A closed rod along z, which takes the place of the plane");
    visit.range(
        "vertices", o.vertices, {.min = 0, .max = 2'000'000},
        "The mesh is subdivided or simplified to this number of vertices; 0 leaves it as it "
        "is");
    visit("scan", o.scan, "Range scans of the shape, unmerged, which then take its place");
  }
};

/// A bumpy plane over [0, width] × [0, depth], z = h sin(2πb x/width) sin(2πb y/depth), with two
/// triangles in each cell. Vertex (i, j) has the index j·columns + i. Throws InputError for sizes
/// out of range.
Shape make_plane(const ShapeOptions& options);

/// The shape of a config in `folder`. Throws InputError if it cannot be read or made.
Shape make_shape(const ShapeOptions& options, const std::filesystem::path& folder);

}  // namespace deformlab
