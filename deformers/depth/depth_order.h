#pragma once

#include <Eigen/Core>
#include <vector>

#include "deformers/depth/depth_memory.h"
#include "deformers/depth/depth_stack.h"
#include "geometry/plane/overlap/overlap.h"

namespace deformlab {

/// The numbers of regions of overlap in an update of the depths.
struct DepthReport {
  int regions = 0;  ///< all regions
  int lasting = 0;  ///< the same sheet is in front as in the last update
  int turned = 0;   ///< the other sheet is in front, because other regions left no other order
  /// No sheet is wholly in front, because either choice closes a cycle, or because regions in which
  /// the one and the other sheet was in front have become one.
  int cyclic = 0;
  int twisted = 0;    ///< a walk through the region exchanges the two sheets (OverlapRegion)
  bool found = true;  ///< false where there are too many pairs of triangles (OverlapFinder)
};

/// A predefined order for shapes that have none (#V, higher is nearer to the viewer): the distance
/// along the edges from the middle of each connected part [length]. So limbs are before the trunk,
/// and later parts are before earlier ones.
Eigen::VectorXd distance_from_middle(const Triangulation& rest);

/// Depths of the triangles of a deformed shape, chosen anew on every update so that sheets that
/// overlap do not run through each other (Igarashi et al. 2005, section 5.1).
///
/// In each region of overlap one sheet is wholly in front. This is the sheet that was in front in
/// the last update, if the region lasts or continues one that is gone (DepthMemory). Otherwise it
/// is the sheet that the predefined order has in front, in the mean over the region's area. Regions
/// are entered into one stack, lasting ones before new ones and large ones before small ones. Where
/// earlier regions leave only one choice (of three sheets, or of triangles that belong to several
/// regions), a region takes it. Where they leave none, each pair of triangles takes the choice that
/// is left to it, and the region is counted as cyclic. Regions may become one, as where two arms
/// that are in front of a body meet at a fold. What was in front in a part of such a region then
/// stays there, and each new pair follows its neighbours.
class DepthOrder {
 public:
  /// `order` is the predefined order (#V, higher is nearer). Throws InputError where it has another
  /// size or is not finite.
  DepthOrder(const Triangulation& rest, const Eigen::VectorXd& order);

  /// Computes the depths for vertices at V (2×#V) [length]. Returns a depth for each triangle (#F,
  /// higher is nearer), which is the number of sheets that are stacked behind it. Triangles that
  /// overlap never have the same depth, so that triangles of one depth can be drawn together. A
  /// triangle that overlaps none takes the depth of the nearest one of its sheet that does, so that
  /// depths change far from the overlaps. Where there are too many pairs of triangles, depths are
  /// ranks in the predefined order. Where OverlapFinder throws InputError, nothing changes.
  const Eigen::VectorXd& update(const Eigen::Matrix2Xd& V);
  /// Forgets which sheets were in front.
  void reset();

  const Eigen::VectorXd& depth() const { return depth_; }  ///< of the last update, or 0
  const Overlaps& overlaps() const { return overlaps_; }   ///< of the last update
  const DepthReport& report() const { return report_; }    ///< of the last update

 private:
  struct Choice {
    int region;
    bool a_in_front, lasting, mixed;
  };

  std::vector<Choice> choices() const;
  void enter(const Choice& choice);
  bool put_all(const OverlapRegion& region, bool a_in_front);
  void put_each(const OverlapRegion& region, bool a_in_front);
  bool put(const TrianglePair& pair, bool a_in_front);
  void put_remembered(const OverlapRegion& region);
  void put_by_neighbours(const OverlapRegion& region, bool a_in_front);
  std::vector<int> sides_by_neighbours(const OverlapRegion& region) const;
  void remember();
  void spread(const std::vector<int>& heights);

  OverlapFinder find_;
  Eigen::VectorXd order_;      ///< #F, the predefined order
  std::vector<int> by_order_;  ///< triangles, back to front
  DepthStack stack_;
  DepthMemory memory_;
  Overlaps overlaps_;
  DepthReport report_;
  Eigen::VectorXd depth_;
};

}  // namespace deformlab
