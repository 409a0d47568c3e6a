#pragma once

#include <filesystem>
#include <string>

#include "experiments/scenes/range_scan.h"
#include "geometry/shape/shape.h"

namespace deformlab {

/// Where a config's shape comes from: a file, or the one generator.
struct ShapeOptions {
  std::string file;        ///< beside the config, below the working folder, or a packaged mesh
  int columns = 201;       ///< of vertices of the generated plane, along x
  int rows = 201;          ///< along y
  double width = 1;        ///< [length]
  double depth = 1;        ///< [length]
  int bumps = 0;           ///< periods of z = bump_height sin sin along each side
  double bump_height = 0;  ///< [length]
  int vertices = 0;        ///< the mesh is subdivided or simplified to so many; 0: it is not
  RangeScanOptions scan;   ///< what a scanner makes of it

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("file", o.file,
          "a shape file: beside the config, here, or among libcgal-demo's meshes; "
          "empty: a plane is generated from the following");
    visit("columns", o.columns, "vertices of the plane along x");
    visit("rows", o.rows, "vertices of the plane along y");
    visit("width", o.width, "its extent along x");
    visit("depth", o.depth, "its extent along y");
    visit("bumps", o.bumps, "periods of its bumps along each side");
    visit("bump_height", o.bump_height, "their amplitude along z");
    visit("vertices", o.vertices, "the mesh is subdivided or simplified to so many; 0: it is not");
    visit("scan", o.scan, "range scans of it, unmerged, in its place");
  }
};

/// A bumpy plane over [0, width] × [0, depth], vertex (i, j) at index j·columns + i, two triangles
/// a cell: z = h sin(2πb x/width) sin(2πb y/depth). Throws InputError for sizes out of range.
Shape make_plane(const ShapeOptions& options);

/// The shape of a config; `folder` is the config's own. Throws InputError where it cannot be had.
Shape make_shape(const ShapeOptions& options, const std::filesystem::path& folder);

}  // namespace deformlab
