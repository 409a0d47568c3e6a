#pragma once

#include <Eigen/Core>

#include "geometry/plane/overlap/overlap.h"

namespace deformlab {

/// How much of where a shape overlaps itself shows two sheets running through each other.
struct Interpenetration {
  double overlap = 0;  ///< area of all regions [length²]
  double area = 0;     ///< of it, where the sheet is in front that is so in less of its region
  double worst = 0;    ///< greatest share of a region where that is so, 0 … ½
  /// Of all overlap, 0 … ½; 0 where nothing overlaps.
  double share() const { return overlap > 0 ? area / overlap : 0; }
};

/// Depths at the corners of each triangle, 3×#F, from one a vertex (#V): linear in between.
/// Throws InputError where F names a vertex that has none.
Eigen::Matrix3Xd vertex_depths(const Eigen::Matrix3Xi& F, const Eigen::VectorXd& depth);

/// The same from one a triangle (#F), constant on it.
Eigen::Matrix3Xd triangle_depths(const Eigen::VectorXd& depth);

/// Measures depths at the corners (3×#F, higher is nearer) on a deformed mesh and what overlaps in
/// it, exactly but for rounding, and 0 exactly where one sheet of every region is wholly in front.
/// Where depths are equal each sheet has half of the area. Regions count whether another sheet
/// hides them or not; a twisted one as far as its pairs tell. Throws InputError where sizes do not
/// fit together or a depth is not finite.
Interpenetration interpenetration(const Triangulation& deformed, const Overlaps& overlaps,
                                  const Eigen::Matrix3Xd& depth);

}  // namespace deformlab
