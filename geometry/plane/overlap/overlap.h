#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/plane/triangulation.h"

namespace deformlab {

/// Two triangles that cover a common area.
struct TrianglePair {
  int a, b;     ///< one of the region's first sheet, one of its second
  double area;  ///< that both cover [length²]
};

/// A place where one sheet of a shape lies over another: pairs of triangles, each of which is
/// reached from any other by going on, on either sheet, to a neighbouring triangle across a part of
/// their edge that the other sheet covers too.
struct OverlapRegion {
  int first, count;  ///< of its pairs, which stand in a row
  double area = 0;   ///< of all of them [length²]
  /// Places where the shape's boundary crosses itself. 0 where the boundary of one sheet lies
  /// wholly over the other, as that of a hole does, or where a fold ends the region.
  int crossings = 0;
  /// The sheets change places on a way round: neither can be said to be in front.
  bool twisted = false;
};

/// Where a deformed shape overlaps itself.
struct Overlaps {
  std::vector<TrianglePair> pairs;     ///< by region; the first pair of each has a < b
  std::vector<OverlapRegion> regions;  ///< in the order of their first pairs
  double area = 0;  ///< of all regions: where three sheets overlap it counts three times [length²]
  int turned_over = 0;   ///< triangles that turn the other way than (x, y)
  bool complete = true;  ///< false: too tangled, and nothing is listed; see OverlapFinder

  std::span<const TrianglePair> pairs_of(const OverlapRegion& region) const {
    return std::span(pairs).subspan(region.first, region.count);
  }
};

/// Finds where a shape overlaps itself once it is deformed (Igarashi et al. 2005, section 5.1), by
/// exact signs: what touches without a common area does not overlap.
///
/// As in the paper, regions grow from the boundary; but not only from where it crosses itself. A
/// region has to end somewhere: where one of its sheets ends (the shape's boundary, be it of a
/// hole) or turns over (a fold between triangles that turn opposite ways). So each holds a triangle
/// with such an edge, and all are found from those, in a time that grows with their number and the
/// number of pairs, but for a search of boxes (#F log² #F). Triangles without area cover nothing
/// and are passed over.
///
/// A shape in which triangles overlap by the dozen everywhere gives up on pairs, of which there may
/// be #F²: beyond 16 #F + 2¹⁷ of them, or of those looked at along edges where sheets end or turn
/// over, the result is empty and not `complete`.
class OverlapFinder {
 public:
  /// Throws InputError where F names a vertex that does not exist.
  explicit OverlapFinder(const Triangulation& rest);

  /// The vertices are at V (2×#V). The same input gives the same bytes. Throws InputError for
  /// another number of vertices than at rest, and for a coordinate that is not finite or beyond
  /// ±1e100, whose areas would not be.
  Overlaps operator()(const Eigen::Matrix2Xd& V) const;

  const Eigen::Matrix3Xi& F() const { return F_; }
  /// 3×#F: the triangle across the edge from each corner to the next; −1 where there is none, more
  /// than one, or one on the same side.
  const Eigen::Matrix3Xi& neighbours() const { return neighbours_; }

 private:
  Eigen::Index vertices_;
  Eigen::Matrix3Xi F_, neighbours_;
};

}  // namespace deformlab
