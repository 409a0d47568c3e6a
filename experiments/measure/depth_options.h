#pragma once

#include <string>

#include "deformers/depth/depth_order.h"
#include "experiments/measure/measurements.h"

namespace deformlab {

/// How parts of a drawing that come to lie over each other are put in order (Igarashi et al. 2005,
/// section 5.1).
struct DepthOptions {
  std::string front = "ends";  ///< the order that is defined beforehand
  bool adjust = true;          ///< false: each triangle keeps the depth that it has at rest

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.choice("front", o.front, {"ends", "right", "left", "bottom", "top"},
                 "where parts overlap, what is in front: what lies farther that way at rest, or "
                 "farther from the middle of the drawing, along it");
    visit("adjust", o.adjust, "false: overlapping parts are left at the depths they have at rest");
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
