#pragma once

#include <vector>

#include "energies/graph/context.h"
#include "energies/graph/nodes.h"
#include "energies/unknowns.h"
#include "geometry/plane/barycentric_point.h"
#include "geometry/plane/triangulation.h"
#include "geometry/transfer/transfer.h"

namespace deformlab::test {

/// What terms are summed over: a deformation graph, the shape and handles embedded in it, and a
/// triangulation with a weight for each of its triangles and points in it.
struct Sample {
  DeformationGraph graph;
  Embedding handles;
  Shape shape;
  Embedding vertices;
  Triangulation mesh;
  Eigen::VectorXd weights;
  std::vector<BarycentricPoint> points;

  int nodes() const { return static_cast<int>(graph.g.cols()); }
  GraphContext context(int d = 3, NodeModel model = NodeModel::kAffine) const {
    return {graph, handles, model, d, shape, vertices, 1};
  }
  /// All nodes at rest.
  template <class Node = AffineNode<3>>
  Unknowns rest() const {
    return Unknowns::uniform(Node::rest().replicate(1, nodes()), nodes());
  }
};

/// n×n vertices over [0, 3]², moved a little at random, and two triangles between four of them.
Triangulation shaken_grid(int n, unsigned seed = 1);

/// The nodes `g`, connected by the points `v`. The points in the first and the last tenth along x
/// are the handles. Everything is in units of the mean edge.
Sample make_sample(const Eigen::Matrix3Xd& g, const Eigen::Matrix3Xd& v, int k);

/// m nodes at random in a thick plate, with 15 points for each node.
Sample random_sample(int m, int k = 4, unsigned seed = 1);

/// Targets of the handles: the upper half along x is rotated by `angle` about x and lifted by
/// `lift`.
Eigen::Matrix3Xd twisted(const Embedding& handles, double angle, double lift);

/// x with normal noise of the given size on every entry.
Unknowns perturbed(Unknowns x, double size, unsigned seed = 1);

}  // namespace deformlab::test
