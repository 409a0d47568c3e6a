#pragma once

#include <Eigen/Geometry>

#include "drawing/vector/vector_path.h"
#include "geometry/plane/locator.h"

namespace deformlab {

/// With more depths, the paths keep their order.
inline constexpr std::size_t kMostLayers = 64;
/// The number of different depths (#F).
std::size_t layers_of(const Eigen::VectorXd& depth);

/// The paths without clips, and without the fills and the middle lines of strokes that lie outside
/// of these. `diagonal` is that of the drawing [length].
std::vector<VectorPath> without_hidden(const std::vector<VectorPath>& paths, double diagonal);

/// Cuts paths at rest so that they can be painted one after the other where the deformed drawing
/// overlaps itself. The triangles of one depth (#F) are a layer, which does not overlap itself. The
/// result has the paths of the farthest layer first, and those of one layer in their own order. A
/// layer extends a little under the ones in front of it, so that there is no gap between them. A
/// path that lies within one layer is not cut. Fills are cut by their clips as well. Without
/// depths, or if all are equal, there is one layer; the same holds if there are more than
/// kMostLayers. The mesh is the one at rest.
std::vector<VectorPath> in_layers(const std::vector<VectorPath>& paths, const Triangulation& rest,
                                  const Locator& locator, const Eigen::VectorXd& depth);

/// Cuts paths at rest along lines (2×n each, n ≥ 2) [length]: what lies on either side of a line is
/// no longer connected there. A path that no line crosses stays as it is.
std::vector<VectorPath> cut_along(const std::vector<VectorPath>& paths,
                                  const std::vector<Eigen::Matrix2Xd>& lines,
                                  const Eigen::AlignedBox2d& page);

}  // namespace deformlab
