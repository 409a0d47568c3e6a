#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/graph/deformation_graph.h"
#include "geometry/graph/graph_cut.h"
#include "geometry/shape/shape.h"
#include "geometry/transfer/embedding.h"

namespace deformlab {

/// All vertices of a shape embedded in a graph.
struct VertexEmbedding {
  Embedding embedding;
  /// Of each vertex, how many of its nodes count: behind a cut, or on a small part of a surface, it
  /// can reach fewer than k. The others have no weight and only fill the column. Empty: all count.
  std::vector<int> followed;
  int unreached = 0;  ///< vertices on parts of the surface where no node is
};

/// Sumner et al. 2007, Eq. 4, by the distance that options.distance names and over the nodes that
/// each vertex's group may follow. With d along the surface: a node's distances are those of the
/// vertex nearest to it, `node_vertices`; a vertex to which no surface leads follows the nodes that
/// are nearest in space.
///   g  3×m node positions [length]
/// Throws InputError for options out of range and as nearest_along_surface does.
VertexEmbedding embed_vertices(const Shape& shape, const Eigen::Matrix3Xd& g,
                               std::span<const int> node_vertices, const CutGroups& groups,
                               const GraphOptions& options);

/// Places that need be no vertices (3×p) [length]: each follows the nodes of the vertex nearest to
/// it, with the same weights. For graphs with cuts or distances along a surface, on which a place
/// beside it has no distance of its own.
Embedding embed_at_vertices(const Eigen::Matrix3Xd& points, const Embedding& vertices);

}  // namespace deformlab
