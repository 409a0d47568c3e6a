#pragma once

#include <cstdint>

#include "geometry/shape/shape.h"

namespace deformlab {

/// A scanner that looks at a shape from all around and gives what scanners give: depth images as
/// meshes that nobody merged, with noise, holes and outliers.
struct RangeScanOptions {
  int views = 0;         ///< depth images, from directions spread over the sphere; 0: no scan
  int resolution = 128;  ///< rays along each side of an image
  double noise = 0.1;    ///< standard deviation of the depth [distance between rays]
  int holes = 6;         ///< patches that each image lacks
  int outliers = 12;     ///< triangles that float in front of the surface, an image
  std::uint64_t seed = 1;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("views", o.views, "depth images taken from all around; 0: the shape itself");
    visit("resolution", o.resolution, "rays along each side of an image");
    visit("noise", o.noise, "standard deviation of the depth, in distances between rays");
    visit("holes", o.holes, "patches that each image lacks");
    visit("outliers", o.outliers, "triangles that float in front of the surface, an image");
    visit("seed", o.seed, "of noise, holes and outliers");
  }
};

/// All images of the shape, one after the other, as one shape. Throws InputError for options out of
/// range and for a shape that no ray meets.
Shape range_scan(const Shape& shape, const RangeScanOptions& options);

}  // namespace deformlab
