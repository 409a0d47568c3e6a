#pragma once

#include "geometry/graph/deformation_graph.h"
#include "geometry/shape/shape.h"
#include "geometry/transfer/embedding.h"

namespace deformlab {

/// The unknowns of the nodes of a graph: AffineNode<dimension>, or RigidNode.
enum class NodeModel { kAffine, kRigid };

inline const Embedding kNoPoints{};
inline const Shape kNoShape{};

/// What the terms over a deformation graph are summed over. Nothing is copied, so that all objects
/// have to exist until the sum is made.
struct GraphContext {
  /// The graph, and the handles embedded in it, in the unit of length of the problem.
  const DeformationGraph& graph;
  const Embedding& handles = kNoPoints;

  NodeModel model = NodeModel::kAffine;
  int dimension = 3;  ///< 2 for a flat shape: z is not used

  /// The shape at rest, and all its vertices embedded in the graph, in the shape's own unit. Divide
  /// a length of these by `unit` to get it in the unit of the problem.
  const Shape& shape = kNoShape;
  const Embedding& vertices = kNoPoints;
  double unit = 1;
};

}  // namespace deformlab
