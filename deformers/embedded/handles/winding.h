#pragma once

#include <Eigen/Core>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "geometry/graph/deformation_graph.h"
#include "geometry/transfer/embedding.h"
#include "geometry/transfer/transfer.h"

namespace deformlab {

/// Turns that are greater cannot be read from a rotation any more [rad].
inline constexpr double kMoreThanHalfTurn = 1.01 * std::numbers::pi;

/// The largest difference of the rotation vectors that neighbouring regions are asked for [rad].
/// Regions are neighbours where no third one is nearer to the nodes between them, counted in edges.
///   handles    of which the first have rotations
///   rotations  as in Handles::rotations; handles of which nothing is known are no region
///   at_rest    of each node: its rotation vector is zero
double turn_between_neighbors(const DeformationGraph& graph, const Embedding& handles,
                              const Eigen::Matrix3Xd& rotations, const std::vector<char>& at_rest);

/// The rotation vectors of the nodes (3×m) [rad] that are reached from nodes at rest without a
/// jump: neighbours differ by less than a half turn. So they show how often a region has turned,
/// which a rotation alone does not. A column is NaN where no path leads.
///   X        3×4m transformations
///   at_rest  of each node
Eigen::Matrix3Xd unwound_rotations(const DeformationGraph& graph, const Transformations& X,
                                   const std::vector<char>& at_rest);

/// A sentence about a region that should turn by more than a half turn and has unwound; nothing if
/// there is none.
///   handles    of which the first have rotations
///   rotations  as in Handles::rotations
///   at_rest    of each node
std::optional<std::string> lost_turn(const DeformationGraph& graph, const Transformations& X,
                                     const Embedding& handles, const Eigen::Matrix3Xd& rotations,
                                     const std::vector<char>& at_rest);

}  // namespace deformlab
