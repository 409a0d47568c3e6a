#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "geometry/graph/deformation_graph.h"
#include "geometry/transfer/embedding.h"
#include "geometry/transfer/transfer.h"

namespace deformlab {

/// The rotation vector of each handle (3×#handles) [rad], or NaN where nothing is known. Handles of
/// one group that span a plane or more show their rotation by where they go, up to full turns. What
/// was asked then tells the number of turns. For other handles, what was asked counts; where
/// nothing was, handles on a line take the shortest turn, because they do not show a roll about it.
///   v, q    3×#handles, the handles at rest and their targets [length]
///   asked   3×#handles or 3×0, as in Handles::rotations
///   groups  as in Handles::groups
Eigen::Matrix3Xd handle_rotations(const Eigen::Matrix3Xd& v, const Eigen::Matrix3Xd& q,
                                  const Eigen::Matrix3Xd& asked, std::span<const int> groups);

/// The handles of a harmonic start and the terms that it balances.
struct StartProblem {
  const DeformationGraph& graph;   ///< g [length]
  const Embedding& handles;        ///< [length]
  const std::vector<char>& fixed;  ///< of each node: it stays at rest
  double w_reg, w_con;
};

/// Transformations (3×4m) near the minimum, from which a solve begins. The rotation vectors of the
/// nodes that handles follow are held, those of fixed nodes are zero, and the others are harmonic:
/// Σ_k ‖g_j − g_k‖⁻² (ω_j − ω_k) = 0. Then t_j minimises w_reg E_reg + w_con E_con (Sumner et al.
/// 2007, Eqs. 7 and 8) with these rotations, which is a linear problem. So a solve does not have to
/// find large rotations step by step from rest, where nodes would turn inside out.
///   rotations  of handle_rotations
///   targets    3×#handles [length]
/// Returns nothing where the linear problems cannot be solved.
std::optional<Transformations> harmonic_start(const StartProblem& problem,
                                              const Eigen::Matrix3Xd& rotations,
                                              const Eigen::Matrix3Xd& targets);

}  // namespace deformlab
