#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "deformers/baselines/prism_layer.h"
#include "solvers/linear/linear_solver.h"

namespace deformlab {

/// Pulls a point of a prism to the target of a handle.
struct Pin {
  int i;                   ///< prism
  int handle;              ///< column of the handles' targets
  double weight;           ///< factor of the squared distance
  Eigen::Vector3d p;       ///< at rest [length]
  Eigen::Vector3d target;  ///< [length]
};

/// The energy E of joints and pins as a function of the prisms' motions, and its Newton steps. A
/// step minimises a quadratic model of E over velocities, which is the global shape matching of
/// Botsch, Pauly, Gross and Kobbelt 2006 with second derivatives. Fixed prisms have no velocity.
class PrismEquations {
 public:
  /// Finds the fill-reducing order. `prisms` has to outlive this object.
  ///   fixed  #prisms, whether the prism does not move
  PrismEquations(const PrismLayer& prisms, std::vector<Pin> pins, const std::vector<char>& fixed);

  std::vector<Pin>& pins() { return pins_; }
  const std::vector<Pin>& pins() const { return pins_; }

  double joint_energy(const RigidMotions& motions) const;  ///< [length²]
  double pin_energy(const RigidMotions& motions) const;    ///< [length²]
  double energy(const RigidMotions& motions) const;        ///< E, the sum of both [length²]

  /// Computes H and Jᵀr at these motions. H is half of E's second derivative without the concave
  /// part of the rotations' curvature, which is stored apart.
  void linearize(const RigidMotions& motions);
  /// Computes the step δ = −(H + λ D)⁻¹ Jᵀr as velocities (6×m: ω_i, v_i). D is diagonal and
  /// contains the mean of each prism's diagonal of H. Where `full`, H includes the concave part.
  /// Returns false where the matrix is not positive definite, or singular in double precision.
  bool solve(bool full, double lambda, Eigen::MatrixXd& velocities);
  /// δᵀJᵀr, which is half of the slope of E along the velocities.
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
  std::vector<int> index_;              // the index of each prism among the free ones, or −1
  std::vector<std::vector<int>> rows_;  // the later prisms that each free prism is joined to
  SparseMatrix H_, damped_;
  Eigen::Matrix3Xd concave_;  // the concave part of the rotations, 3×3 for each free prism
  Eigen::VectorXd Jtr_, delta_;
  std::unique_ptr<LinearSolver> solver_;
};

}  // namespace deformlab
