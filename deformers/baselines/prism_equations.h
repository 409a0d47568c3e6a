#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "deformers/baselines/prisms.h"
#include "solvers/linear/linear_solver.h"

namespace deformlab {

/// Pulls a point of a prism to where a handle is.
struct Pin {
  int i;                   ///< prism
  int handle;              ///< column of the handles' targets
  double weight;           ///< of the squared distance
  Eigen::Vector3d p;       ///< at rest [length]
  Eigen::Vector3d target;  ///< [length]
};

/// The energy E of joints and pins over the motions of prisms, and its Gauss–Newton steps: E is
/// minimised over velocities, to which the motions are linear (the global shape matching of Botsch,
/// Pauly, Gross and Kobbelt 2006). Held prisms have none.
class PrismEquations {
 public:
  /// Finds the fill-reducing order. `prisms` has to outlive this.
  ///   held  one entry a prism
  PrismEquations(const PrismLayer& prisms, std::vector<Pin> pins, const std::vector<char>& held);

  std::vector<Pin>& pins() { return pins_; }
  const std::vector<Pin>& pins() const { return pins_; }

  double joint_energy(const RigidMotions& motions) const;  ///< [length²]
  double pin_energy(const RigidMotions& motions) const;    ///< [length²]
  double energy(const RigidMotions& motions) const;        ///< E, of both

  /// H and Jᵀr at these motions. H is half of E's second derivative, with what makes it concave
  /// kept apart.
  void linearize(const RigidMotions& motions);
  /// δ = −(H + λ D)⁻¹ Jᵀr as velocities (6×m: ω_i, v_i), D the mean of each prism's diagonal; with
  /// the concave part of H where `full`. False where the matrix is not positive definite, or
  /// singular in double precision.
  bool solve(bool full, double lambda, Eigen::MatrixXd& velocities);
  /// δᵀJᵀr, half the slope of E along velocities.
  double slope(const Eigen::MatrixXd& velocities) const;

  double gradient_max() const { return 2 * Jtr_.lpNorm<Eigen::Infinity>(); }  ///< ‖∇E‖∞
  int unknowns() const { return static_cast<int>(Jtr_.size()); }
  const SparseMatrix& H() const { return H_; }  ///< lower triangle, in the fill-reducing order
  long nonzeros_factor() const { return solver_->nonzeros(); }

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  void find_order();
  void build_structure();
  void add_curvature(const Eigen::Matrix3Xd& C);
  void add_block(int row, int column, const Matrix6& block);

  const PrismLayer& prisms_;
  std::vector<Pin> pins_;
  std::vector<int> place_;              // of each prism among the free ones, or −1
  std::vector<std::vector<int>> rows_;  // of each place the later ones it is joined to
  SparseMatrix H_, damped_;
  Eigen::Matrix3Xd concave_;  // of the rotations, 3×3 a place
  Eigen::VectorXd Jtr_, delta_;
  std::unique_ptr<LinearSolver> solver_;
};

}  // namespace deformlab
