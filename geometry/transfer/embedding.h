#pragma once

#include <Eigen/Core>
#include <span>

namespace deformlab {

/// The largest k of Eq. 4 that a graph may be asked for.
inline constexpr int kMaxNeighbors = 16;

/// Points embedded in a deformation graph: whom each follows, and how much. A whole shape is
/// embedded to be deformed (Eq. 2), its handles are to be constrained (Eq. 8).
struct Embedding {
  Eigen::Matrix3Xd v;       ///< 3×n rest positions [length]
  Eigen::MatrixXi nodes;    ///< k×n indices of the nearest nodes, nearest first
  Eigen::MatrixXd weights;  ///< k×n weights w_j(v_i), each column ≥ 0 and of sum one
};

/// Eq. 4 for one point, in place: its distances to the k+1 nearest nodes, nearest first [length],
/// become the k weights and an entry without meaning.
void weigh(Eigen::Ref<Eigen::VectorXd> distances, int k);

/// Sumner et al. 2007, Eq. 4: w_j(v) = (1 − ‖v − g_j‖/d_max)², normalised, d_max the distance to
/// node k+1.
///   v  3×n points, g  3×m node positions [length], k ≥ 1 nodes for each point.
/// Where the formula says nothing: with m ≤ k nodes, k becomes m − 1 (one node alone: weight 1);
/// with nodes 1 … k+1 equally far it is 0/0, and the k nearest share equally.
/// Throws InputError for m = 0 or k outside 1 … kMaxNeighbors.
Embedding embed(const Eigen::Matrix3Xd& v, const Eigen::Matrix3Xd& g, int k);

/// The points of one embedding, then those of another in the same graph with the same k.
Embedding joined(const Embedding& first, const Embedding& second);

/// The embedding of some of its points, in the order of `indices` (0 ≤ index < n).
Embedding subset(const Embedding& embedding, std::span<const int> indices);

}  // namespace deformlab
