#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/graph/deformation_graph.h"
#include "geometry/graph/graph_cut.h"
#include "geometry/shape/weld.h"
#include "geometry/transfer/embedding.h"

namespace deformlab {

/// All vertices of a shape, embedded in a graph.
struct VertexEmbedding {
  Embedding embedding;
  /// For each vertex, how many of its nodes count. Behind a cut, or on a small part of a surface, a
  /// vertex reaches fewer than k nodes; the others have no weight and only fill the column. Empty
  /// where all nodes count.
  std::vector<int> followed;
  int unreached = 0;  ///< the number of vertices on parts of the surface without a node
};

/// Sumner et al. 2007, Eq. 4, with the distance that options.distance names and over the nodes that
/// the group of each vertex may follow. Along the surface, the distances of a node are those of its
/// nearest vertex in `node_vertices`, and a vertex on a part of the surface without a node follows
/// the nodes that are nearest in space.
///   g  3×m node positions [length]
/// Throws InputError for options out of range and as nearest_along_surface does.
VertexEmbedding embed_vertices(const WeldedSurface& surface, const Eigen::Matrix3Xd& g,
                               std::span<const int> node_vertices, const CutGroups& groups,
                               const GraphOptions& options);

/// Embeds points that need not be vertices (3×p) [length]: each follows the nodes of the vertex
/// that is nearest to it, with the same weights. This is for graphs with cuts or with distances
/// along a surface, where a point beside the surface has no distance of its own.
Embedding embed_at_vertices(const Eigen::Matrix3Xd& points, const Embedding& vertices);

}  // namespace deformlab
