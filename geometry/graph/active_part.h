#pragma once

#include <span>
#include <vector>

#include "geometry/graph/graph_cut.h"
#include "geometry/shape/shape.h"
#include "geometry/transfer/embedding.h"

namespace deformlab {

/// The part of a shape that an edit can move: all vertices that are not fixed, and the fixed ones
/// around them.
struct ActivePart {
  Shape shape;                ///< with the faces all of whose corners are in the part
  std::vector<int> vertices;  ///< of the whole shape, for each vertex of the part, ascending

  bool is_whole(const Shape& whole) const { return shape.V.cols() == whole.V.cols(); }
};

/// Finds the active part for a graph of m nodes. Fixed vertices belong to it if a face joins them
/// to a vertex that is not fixed, or if they are within two to six node spacings of one. If all
/// vertices are fixed, the part is the whole shape.
ActivePart active_part(const Shape& shape, std::span<const int> fixed, int m);

/// The cuts with the vertices of the part. A cut of which one side is outside of it is left out.
std::vector<Cut> cuts_of(const ActivePart& part, std::span<const Cut> cuts, Eigen::Index vertices);

/// The embedding of all vertices V (3×#V) [length] of the whole shape. Vertices outside of the part
/// are fixed; they follow the first node only, so that they join no two nodes.
Embedding embedding_of_whole(const ActivePart& part, const Embedding& of_part,
                             const Eigen::Matrix3Xd& V);

}  // namespace deformlab
