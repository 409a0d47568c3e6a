#pragma once

#include <cstdint>

#include "geometry/core/options.h"
#include "geometry/shape/shape.h"

namespace deformlab {

/// A scanner that looks at a shape from all around. Like real scans, its depth images are meshes
/// that are not merged, with noise, holes and outliers.
struct RangeScanOptions {
  int views = 0;         ///< depth images, from directions all around; 0: no scan
  int resolution = 128;  ///< rays along each side of an image
  double noise = 0.1;    ///< standard deviation of the depth [distance between rays]
  int holes = 6;         ///< patches that each image lacks
  int outliers = 12;     ///< triangles in each image that float in front of the surface
  std::uint64_t seed = 1;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("views", o.views, {.min = 0, .max = 64},
                "The number of depth images that are taken from all around; 0 keeps the shape "
                "itself");
    visit.range("resolution", o.resolution, {.min = 8, .max = 2048},
                "The number of rays along each side of a depth image");
    visit.range("noise", o.noise, {.min = 0, .max = 10},
                "The standard deviation of the depth, in distances between rays");
    visit.range("holes", o.holes, {.min = 0, .max = 1000},
                "The number of patches that are missing in each image");
    visit.range("outliers", o.outliers, {.min = 0, .max = 1000},
                "The number of triangles in each image that float in front of the surface");
    visit("seed", o.seed, "The seed of the random numbers for noise, holes and outliers");
  }
};

/// All images of the shape, one after the other, as one shape. Throws InputError for options out of
/// range, and for a shape that no ray meets.
Shape range_scan(const Shape& shape, const RangeScanOptions& options);

}  // namespace deformlab
