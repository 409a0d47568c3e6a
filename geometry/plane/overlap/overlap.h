#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/plane/triangulation.h"

namespace deformlab {

/// Two triangles that cover a common area.
struct TrianglePair {
  int a, b;     ///< triangles of the first and the second sheet of their region
  double area;  ///< area that both cover [length²]
};

/// A region where one sheet of a shape lies over another: a connected set of pairs of triangles.
/// Two pairs are connected if a step on either sheet, across a part of an edge that the other sheet
/// also covers, leads from one pair to the other.
struct OverlapRegion {
  int first, count;  ///< its pairs are consecutive
  double area = 0;   ///< sum over its pairs [length²]
  /// Number of points where the shape's boundary crosses itself. It is 0 where the boundary of one
  /// sheet lies wholly over the other, as that of a hole may, or where folds end the region.
  int crossings = 0;
  /// Whether a walk through the region exchanges the sheets, so that neither of them is in front.
  bool twisted = false;
};

/// Where a deformed shape overlaps itself.
struct Overlaps {
  std::vector<TrianglePair> pairs;     ///< ordered by region; the first pair of each has a < b
  std::vector<OverlapRegion> regions;  ///< in the order of their first pairs
  double area = 0;  ///< of all regions [length²]; where three sheets overlap it counts three times
  int turned_over = 0;   ///< number of triangles that turn the other way than (x, y)
  bool complete = true;  ///< false where there are too many pairs; none of them is then listed

  std::span<const TrianglePair> pairs_of(const OverlapRegion& region) const {
    return std::span(pairs).subspan(region.first, region.count);
  }
};

/// Finds where a deformed shape overlaps itself (Igarashi et al. 2005, section 5.1). Signs are
/// exact, so that triangles that touch without a common area do not overlap.
///
/// The paper grows regions from the points where the boundary crosses itself, but not every region
/// has such a point. Every region has an edge where one of its sheets ends (at the boundary of the
/// shape or of a hole) or turns over (at a fold between triangles of opposite orientation), so that
/// all regions are found from the triangles with such an edge. The time grows with the number of
/// these triangles and of pairs, apart from a search of boxes (#F log² #F). Triangles without area
/// are skipped.
///
/// There may be #F² pairs. Where there are more than 16 #F + 2¹⁷ pairs, or candidates for a pair at
/// such an edge, the search stops, and the result is empty and not `complete`.
class OverlapFinder {
 public:
  /// Throws InputError where F names a vertex that does not exist.
  explicit OverlapFinder(const Triangulation& rest);

  /// The overlaps when the vertices are at V (2×#V). The same input gives the same bytes. Throws
  /// InputError where V has another number of vertices than the rest shape, or a coordinate that is
  /// not finite or is beyond ±1e100, for which areas would not be finite.
  Overlaps operator()(const Eigen::Matrix2Xd& V) const;

  const Eigen::Matrix3Xi& F() const { return F_; }
  /// 3×#F: the triangle across the edge from each corner to the next one; −1 where there is none,
  /// more than one, or one on the same side of the edge.
  const Eigen::Matrix3Xi& neighbours() const { return neighbours_; }

 private:
  Eigen::Index vertices_;
  Eigen::Matrix3Xi F_, neighbours_;
};

}  // namespace deformlab
