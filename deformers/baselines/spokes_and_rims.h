#pragma once

#include <Eigen/Core>

namespace deformlab {

/// The as-rigid-as-possible energy of spokes and rims (Chao, Pinkall, Sanan and Schröder 2010):
/// Σ_i Σ_{t ∋ i} Σ_{e ∈ t} cot α_e ‖q_e − R_i p_e‖², where each R_i is the rotation that minimises
/// it.
struct SpokesAndRims {
  double energy = 0;  ///< [length²]
  double scale = 0;  ///< Σ |cot α_e| ‖p_e‖² over the same terms, the size of the energy [length²]
  Eigen::Matrix3Xd R;  ///< 3×3n rotations R_i side by side
};

///   V, W  3×n vertices at rest and deformed [length]
///   T     3×m triangles
SpokesAndRims spokes_and_rims(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xd& W,
                              const Eigen::Matrix3Xi& T);

}  // namespace deformlab
