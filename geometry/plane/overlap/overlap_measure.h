#pragma once

#include <Eigen/Core>

#include "geometry/plane/overlap/overlap.h"

namespace deformlab {

/// How much the sheets of a shape that overlaps itself run through each other.
struct Interpenetration {
  double overlap = 0;  ///< area of all regions [length²]
  double area = 0;   ///< part of it where the sheet is in front that is behind in most of a region
  double worst = 0;  ///< greatest share of that part in the area of a region, 0 … ½
  /// The share of `area` in `overlap`, 0 … ½, or 0 where nothing overlaps.
  double share() const { return overlap > 0 ? area / overlap : 0; }
};

/// The depths at the corners of each triangle (3×#F) for one depth per vertex (#V). Throws
/// InputError where F names a vertex that has none.
Eigen::Matrix3Xd vertex_depths(const Eigen::Matrix3Xi& F, const Eigen::VectorXd& depth);

/// The depths at the corners of each triangle (3×#F) for one depth per triangle (#F).
Eigen::Matrix3Xd triangle_depths(const Eigen::VectorXd& depth);

/// Measures how far sheets run through each other in the overlaps of a deformed mesh. `depth` is at
/// the corners of each triangle (3×#F), linear in between, and higher is nearer. The result is
/// exact except for rounding, and exactly 0 where one sheet of every region is wholly in front.
/// Where depths are equal, each sheet gets half of the area. Regions that another sheet hides count
/// too. Throws InputError where sizes do not fit together or a depth is not finite.
Interpenetration interpenetration(const Triangulation& deformed, const Overlaps& overlaps,
                                  const Eigen::Matrix3Xd& depth);

}  // namespace deformlab
