#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "energies/graph/context_handles.h"
#include "geometry/graph/deformation_graph.h"
#include "geometry/shape/shape.h"
#include "geometry/transfer/embedding.h"

namespace deformlab {

/// The unknowns of the nodes of a graph: AffineNode<dimension>, or RigidNode.
enum class NodeModel { kAffine, kRigid };

inline const Embedding kNoPoints{};
inline const Shape kNoShape{};
inline const Eigen::VectorXd kNoFactors{};

/// What the terms over a deformation graph are summed over. Nothing is copied, so that all objects
/// have to exist until the sum is made.
struct GraphContext {
  /// The graph, and the handles embedded in it, in the unit of length of the problem.
  const DeformationGraph& graph;
  ContextHandles handles = kNoPoints;

  NodeModel model = NodeModel::kAffine;
  int dimension = 3;  ///< 2 for a flat shape: z is not used

  /// The shape at rest, and all its vertices embedded in the graph, in the shape's own unit. Divide
  /// a length of these by `unit` to get it in the unit of the problem.
  const Shape& shape = kNoShape;
  const Embedding& vertices = kNoPoints;
  double unit = 1;

  /// A weight for each handle. Empty: all are 1.
  const Eigen::VectorXd& handle_weights = kNoFactors;
  /// The stiffness of each node, a factor of E_rot and, for edges, of E_reg. Empty: all are 1.
  const Eigen::VectorXd& stiffness = kNoFactors;

  double weight_of_handle(Eigen::Index l) const {
    return handle_weights.size() == 0 ? 1 : handle_weights[l];
  }
  double stiffness_of(Eigen::Index j) const { return stiffness.size() == 0 ? 1 : stiffness[j]; }
  /// An edge is as stiff as the softer of its nodes.
  double stiffness_of(Eigen::Index j, Eigen::Index k) const {
    return std::min(stiffness_of(j), stiffness_of(k));
  }
};

}  // namespace deformlab
