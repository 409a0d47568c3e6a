#pragma once

#include "drawing/bitmap/cut_lines.h"
#include "geometry/plane/locator.h"

namespace deformlab {

/// Places that tell on which side of a cut points lie (2×n each) [length]. The mesh ends a little
/// beside a cut, so that the triangle that is nearest to a point of the cut may lie on the other
/// side. A point of a cut therefore asks for the triangle at a place that is farther away from the
/// cut on its own side, where the mesh is nearer than the cut. For all other points the place is
/// the point itself.
Eigen::Matrix2Xd places_beside(const CutLines& cuts, const Eigen::Matrix2Xd& points,
                               const Triangulation& rest, const Locator& locator);

}  // namespace deformlab
