#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "geometry/core/options.h"
#include "geometry/plane/region.h"

namespace deformlab {

struct TraceOptions {
  double threshold = 0.5;
  bool fill_holes = false;
  double least_hole = 1;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("threshold", o.threshold, {.min = 0, .max = 1, .exclusive_min = true},
                "The opacity from which on a point belongs to the shape");
    visit("fill_holes", o.fill_holes, "Whether all holes of the shape are filled");
    visit.range("least_hole", o.least_hole, {.min = 0},
                "Holes of a smaller area than this are filled [pixel²]");
  }
};

/// The shape that was found in an image.
struct Silhouette {
  Region region;                   ///< the connected part with the largest area [pixel]
  std::vector<Region> detached{};  ///< the other parts, larger ones first [pixel]
  double detached_share = 0;       ///< their share of the area of all parts, 0 … 1
  int filled_holes = 0;            ///< number of holes that were filled, in all parts
};

/// Traces the outline of the opaque pixels by marching squares (Igarashi et al. 2005, section 3).
/// Linear interpolation makes it more precise than a pixel. `alpha` is H×W, from 0 (transparent) to
/// 1, and its entry (row, column) is at x = column + ½, y = row + ½. A shape that touches the
/// image's border ends exactly there. Memory grows with the length of all boundaries. Throws
/// InputError where nothing is opaque, the image is empty, an entry is not finite, or an option is
/// out of range. `name` is what the message calls the image.
Silhouette trace(const Eigen::ArrayXXf& alpha, const TraceOptions& options,
                 const std::string& name);

}  // namespace deformlab
