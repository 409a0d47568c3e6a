#pragma once

#include <string>
#include <vector>

#include "drawing/bound_drawing.h"
#include "render/image.h"

namespace deformlab {

/// What one picture of a drawing shows, in the coordinates of the drawing [length]. Empty members
/// are not drawn.
struct DrawingPanel {
  Eigen::Matrix2Xd V;        ///< 2×#V vertices
  Eigen::VectorXd depth;     ///< #F; a triangle of greater depth is in front
  bool drawing = true;       ///< shows the drawing; otherwise its mesh as plain triangles
  bool edges = false;        ///< shows edges over the drawing; plain triangles always have edges
  Eigen::Matrix2Xd loose;    ///< 2×3#F, corners of triangles that are shown instead (Figure 3)
  Eigen::VectorXd tint;      ///< #F, strength of the tint of each triangle, 0 … 1
  Eigen::Matrix2Xd handles;  ///< 2×p positions of the handles
  Eigen::VectorXd angles;    ///< p, directions of rotation handles [radian], NaN for others
  Eigen::Matrix2Xd targets;  ///< 2×p targets of the handles, shown with a line to each handle
  std::string caption;
};

/// The bounding box of all panels, with a margin. Throws InputError as draw_panel does.
Page frame_of(const BoundDrawing& drawing, const std::vector<DrawingPanel>& panels);

/// The panel on white, over its caption. `frame` fills `width` pixels. Panels with the same frame
/// and width can be compared. The same input gives the same bytes. Throws InputError if a
/// coordinate is not finite, sizes do not fit together, or the image would be too large.
Image draw_panel(const BoundDrawing& drawing, const DrawingPanel& panel, const Page& frame,
                 int width = 400);

}  // namespace deformlab
