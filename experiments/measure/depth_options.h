#pragma once

#include <array>

#include "deformers/depth/depth_order.h"
#include "experiments/config/config_node.h"
#include "experiments/measure/measurements.h"
#include "geometry/core/options.h"

namespace deformlab {

/// The parts that are in front where a drawing overlaps itself: those that are farther from its
/// middle, measured along the drawing, or those that are farther to one side at rest.
enum class DepthFront { kEnds, kRight, kLeft, kBottom, kTop };
constexpr auto names_of(DepthFront) {
  using enum DepthFront;
  return std::to_array<EnumName<DepthFront>>(
      {{kEnds, "ends"}, {kRight, "right"}, {kLeft, "left"}, {kBottom, "bottom"}, {kTop, "top"}});
}

/// How the depths of a drawing are found where it overlaps itself (Igarashi et al. 2005, section
/// 5.1).
struct DepthOptions {
  DepthFront front = DepthFront::kEnds;  ///< the order of the drawing at rest
  ConfigNode parts;                      ///< levels of single parts, which come before `front`
  bool adjust = true;  ///< false: each triangle keeps the depth that it has at rest

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("front", o.front,
          "Which parts are in front where parts overlap: those that are farther from the middle of "
          "the drawing, measured along it (ends), or those that lie farther to one side at rest");
    visit("parts", o.parts,
          "Levels of single parts, which come before `front`: a list of {select: SELECTION, level: "
          "n}; parts of a higher level are in front, and that of the others is 0");
    visit("adjust", o.adjust,
          "Whether overlapping parts are moved apart in depth; otherwise they keep the depths that "
          "they have at rest");
  }
};

/// The depths of a drawing, which follow the updates of its mesh.
class DrawingDepth {
 public:
  /// `levels` are those of single parts (#V), or of size 0 if there are none.
  DrawingDepth(const DepthOptions& options, const Triangulation& rest,
               const Eigen::VectorXd& levels = {});

  /// Returns the depth of each triangle (#F) with the vertices at V (2×#V). A triangle of greater
  /// depth is in front.
  const Eigen::VectorXd& update(const Eigen::Matrix2Xd& V);

  /// Returns to the drawing at rest: forgets which parts were in front.
  void reset() { adjusted_.reset(); }

  const Overlaps& overlaps() const { return adjusted_.overlaps(); }  ///< of the last update

  /// About the last update:
  ///   overlap_area             overlapping area, as a part of the drawing's area at rest
  ///   overlap_regions          number of regions in which parts overlap
  ///   interpenetration         the greatest share of a region where the sheet is in front that is
  ///                            behind in most of the region: at most ½, and 0 if one sheet of each
  ///                            region is completely in front
  ///   interpenetration_static  the same with the depths of the vertices at rest
  Metrics metrics(const Eigen::Matrix2Xd& V) const;

 private:
  DepthOptions options_;
  Triangulation rest_;
  Eigen::VectorXd order_;   // #V
  Eigen::VectorXd static_;  // #F
  DepthOrder adjusted_;
};

}  // namespace deformlab
