#pragma once

#include <Eigen/Core>
#include <vector>

#include "deformers/depth/depth_memory.h"
#include "deformers/depth/depth_stack.h"
#include "geometry/plane/overlap/overlap.h"

namespace deformlab {

/// What an update of the depths met, in numbers of regions.
struct DepthReport {
  int regions = 0;    ///< all of them
  int lasting = 0;    ///< those that show the same sheet in front as the last update
  int turned = 0;     ///< those turned against it, as others left no other order
  int cyclic = 0;     ///< those without one sheet wholly in front: either way closes a circle
  int twisted = 0;    ///< those whose sheets change places on a way round (OverlapRegion)
  bool found = true;  ///< false: too tangled to be searched (OverlapFinder)
};

/// An order for shapes that come without one (#V, higher is nearer): the distance along the edges
/// from the middle of each connected part, so that limbs come before the trunk, and later parts
/// before earlier ones.
Eigen::VectorXd distance_from_middle(const Triangulation& rest);

/// Depths of the triangles of a deformed shape, chosen anew on every update so that sheets that
/// overlap do not run through each other (Igarashi et al. 2005, section 5.1).
///
/// One sheet of each region of overlap is wholly in front: that of the last update while they share
/// a pair of triangles or one takes up where the other left off (DepthMemory); else the one that
/// the predefined order has in front, on the average over the region's area. Regions are entered
/// into one stack, those that last before new ones and great before small. Where the sheets entered
/// so far leave a region no other choice (of three sheets, or of triangles that reach into several
/// regions), it takes that one. Where they leave none, each of its pairs in turn takes what is
/// left, and it is counted as cyclic.
class DepthOrder {
 public:
  /// `order` is the predefined one (#V, higher is nearer). Throws InputError where it is of another
  /// size or not finite.
  DepthOrder(const Triangulation& rest, const Eigen::VectorXd& order);

  /// The vertices are at V (2×#V). Returns a depth a triangle (#F), higher is nearer, no two that
  /// overlap having the same: how many sheets are stacked behind, 0 … So triangles of one depth may
  /// be drawn together. What overlaps nothing takes the depth of the nearest triangle of its sheet
  /// that does, and depths change far from where they matter. A tangled shape has the predefined
  /// order's ranks. Throws InputError as OverlapFinder does, and then is as it was.
  const Eigen::VectorXd& update(const Eigen::Matrix2Xd& V);
  /// Forgets which sheets were in front.
  void reset();

  const Eigen::VectorXd& depth() const { return depth_; }  ///< of the last update; 0 before
  const Overlaps& overlaps() const { return overlaps_; }   ///< of the last update
  const DepthReport& report() const { return report_; }    ///< on the last update

 private:
  struct Choice {
    int region;
    bool a_in_front, lasting;
  };

  std::vector<Choice> choices() const;
  void enter(const Choice& choice);
  bool put_all(const OverlapRegion& region, bool a_in_front);
  void put_each(const OverlapRegion& region, bool a_in_front);
  void remember();
  void spread(const std::vector<int>& heights);

  OverlapFinder find_;
  Eigen::VectorXd order_;      ///< #F
  std::vector<int> by_order_;  ///< triangles, back to front
  DepthStack stack_;
  DepthMemory memory_;
  Overlaps overlaps_;
  DepthReport report_;
  Eigen::VectorXd depth_;
};

}  // namespace deformlab
