#pragma once

#include <array>

#include "deformers/depth/depth_order.h"
#include "experiments/measure/measurements.h"
#include "geometry/core/options.h"

namespace deformlab {

/// Which parts are in front where parts of a drawing overlap: those that are farther from the
/// middle of the drawing, measured along it, or those that lie farther to one side at rest.
enum class DepthFront { kEnds, kRight, kLeft, kBottom, kTop };
constexpr auto names_of(DepthFront) {
  using enum DepthFront;
  return std::to_array<EnumName<DepthFront>>(
      {{kEnds, "ends"}, {kRight, "right"}, {kLeft, "left"}, {kBottom, "bottom"}, {kTop, "top"}});
}

/// How parts of a drawing that come to lie over each other are put in order (Igarashi et al. 2005,
/// section 5.1).
struct DepthOptions {
  DepthFront front = DepthFront::kEnds;  ///< the order that is defined beforehand
  bool adjust = true;  ///< false: each triangle keeps the depth that it has at rest

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("front", o.front,
          "Which parts are in front where parts overlap: those that are farther from the middle of "
          "the drawing, measured along it (ends), or those that lie farther to one side at rest");
    visit("adjust", o.adjust,
          "Whether overlapping parts are moved apart in depth; otherwise they keep the depths that "
          "they have at rest");
  }
};

/// The depths of a drawing through the updates of its mesh.
class DrawingDepth {
 public:
  DrawingDepth(const DepthOptions& options, const Triangulation& rest);

  /// The vertices are at V (2×#V). Returns a depth a triangle (#F), higher is nearer.
  const Eigen::VectorXd& update(const Eigen::Matrix2Xd& V);

  /// On the last update: overlap_area, in areas of the drawing at rest; overlap_regions; and
  /// interpenetration, the greatest share of a region where the sheet is in front that is behind in
  /// the rest of it (0 where one sheet of each is wholly in front, ½ at most), with the depths that
  /// were returned, interpenetration_static with those of the vertices at rest.
  Metrics metrics(const Eigen::Matrix2Xd& V) const;

 private:
  DepthOptions options_;
  Triangulation rest_;
  Eigen::VectorXd order_;   // #V
  Eigen::VectorXd static_;  // #F
  DepthOrder adjusted_;
};

}  // namespace deformlab
