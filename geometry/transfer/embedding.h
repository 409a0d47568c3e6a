#pragma once

#include <Eigen/Core>
#include <span>

#include "geometry/core/options.h"

namespace deformlab {

/// The largest k of Eq. 4 that a graph may have.
inline constexpr int kMaxNeighbors = 16;
inline constexpr Range kNeighborRange{.min = 1, .max = kMaxNeighbors};

/// Points embedded in a deformation graph: the nodes that each point follows, and their weights. A
/// whole shape is embedded to be deformed (Eq. 2), and its handles to be constrained (Eq. 8).
struct Embedding {
  Eigen::Matrix3Xd v;       ///< 3×n rest positions [length]
  Eigen::MatrixXi nodes;    ///< k×n indices of the nearest nodes, the nearest first
  Eigen::MatrixXd weights;  ///< k×n weights w_j(v_i) ≥ 0; the sum of each column is one
};

/// Computes Eq. 4 for one point in place: the distances to its k+1 nearest nodes, the nearest first
/// [length], are replaced by k weights and an entry without meaning.
void weigh(Eigen::Ref<Eigen::VectorXd> distances, int k);

/// Sumner et al. 2007, Eq. 4: w_j(v) = (1 − ‖v − g_j‖/d_max)², normalised to a sum of one, where
/// d_max is the distance to the node that is nearest after the k nodes that v follows.
///   v  3×n points, g  3×m node positions [length], k ≥ 1 nodes for each point.
/// Two cases are not covered by the formula. With m ≤ k nodes, k becomes m − 1, and a single node
/// gets weight 1. Where the k+1 nearest nodes are equally far, the weights are equal.
/// Throws InputError for m = 0, for a k outside of kNeighborRange, and for a position that is not
/// finite.
Embedding embed(const Eigen::Matrix3Xd& v, const Eigen::Matrix3Xd& g, int k);

/// Throws InputError where the parts of an embedding do not have the same number of points, where
/// it names a node that is not among 0 … m − 1, or where a weight is not finite.
void check(const Embedding& embedding, Eigen::Index m);

/// The points of one embedding followed by those of another in the same graph. Throws InputError
/// where their k is not the same.
Embedding joined(const Embedding& first, const Embedding& second);

/// The embedding of some of its points, in the order of `indices`. Throws InputError for an index
/// that is not among 0 … n − 1.
Embedding subset(const Embedding& embedding, std::span<const int> indices);

}  // namespace deformlab
