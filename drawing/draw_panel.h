#pragma once

#include <string>
#include <vector>

#include "drawing/bound_drawing.h"
#include "render/image.h"

namespace deformlab {

/// What one picture of a drawing shows, in the coordinates of the drawing. Empty members are not
/// drawn.
struct DrawingPanel {
  Eigen::Matrix2Xd V;      ///< 2×#V vertices
  Eigen::VectorXd depth;   ///< #F; a triangle of greater depth is in front
  bool drawing = true;     ///< the drawing itself; else its mesh as plain triangles
  bool edges = false;      ///< the mesh's edges over the drawing; plain triangles have them anyway
  Eigen::Matrix2Xd loose;  ///< 2×3#F corners of triangles shown in place of all that (Figure 3)
  Eigen::VectorXd tint;    ///< #F, how strongly triangles are tinted, 0 … 1
  Eigen::Matrix2Xd handles;  ///< 2×p positions of the handles
  Eigen::VectorXd angles;    ///< p, directions of rotation handles [radian], NaN for others
  Eigen::Matrix2Xd targets;  ///< 2×p where the handles should be, joined to them
  std::string caption;
};

/// The box of all that the panels show, with a margin.
Page frame_of(const BoundDrawing& drawing, const std::vector<DrawingPanel>& panels);

/// The panel on white, over its caption; `frame` fills `width` pixels. Panels with one frame and
/// width can be compared. The same input gives the same bytes. Throws InputError where a coordinate
/// is not finite, sizes do not fit together, or the image would be too large.
Image draw_panel(const BoundDrawing& drawing, const DrawingPanel& panel, const Page& frame,
                 int width = 400);

}  // namespace deformlab
