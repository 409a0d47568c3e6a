#pragma once

#include <Eigen/Core>
#include <string>

#include "geometry/core/options.h"
#include "geometry/plane/region.h"

namespace deformlab {

/// How a silhouette is traced.
struct TraceOptions {
  double threshold = 0.5;   ///< opacity from which on a place belongs to the shape
  bool fill_holes = false;  ///< the shape is taken for solid
  double least_hole = 1;    ///< smaller holes are filled [pixel²]

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("threshold", o.threshold, {.min = 0, .max = 1, .exclusive_min = true},
                "The opacity from which on a point belongs to the shape");
    visit("fill_holes", o.fill_holes, "Whether all holes of the shape are filled");
    visit.range("least_hole", o.least_hole, {.min = 0},
                "Holes of a smaller area than this are filled [pixel²]");
  }
};

/// What was found in an image.
struct Silhouette {
  Region region;              ///< the part of largest area [pixel], checked
  int left_out = 0;           ///< number of other parts, detached from it
  double left_out_share = 0;  ///< their share of the area of all parts, 0 … 1
  int filled_holes = 0;       ///< of this part
};

/// The outline of what is opaque, by marching squares with linear interpolation, so below a pixel's
/// precision (Igarashi et al. 2005, section 3). `alpha` is H×W, from 0 (transparent) to 1, its
/// entry (row, column) at the place (column + ½, row + ½). All beyond the image's border is
/// transparent: what touches the border ends exactly there. Pixels that touch in a corner only are
/// taken for connected where the surface between them is. Memory grows with the length of all
/// boundaries. Throws InputError where nothing is opaque, the image is empty, an entry is not
/// finite, or an option is out of range; `name` is what the message calls the image.
Silhouette trace(const Eigen::ArrayXXf& alpha, const TraceOptions& options,
                 const std::string& name);

}  // namespace deformlab
