#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "deformers/arap_2d/component_motion.h"
#include "deformers/arap_2d/connectivity.h"
#include "deformers/arap_2d/handle_system.h"
#include "deformers/arap_2d/two_step_solver.h"

namespace deformlab {

/// The closed form of the two steps for one connected component of a mesh. Its arguments are
/// matrices of the whole mesh, of which it reads and writes the columns of the component. A
/// component without a handle writes nothing.
class ComponentSolver {
 public:
  /// Registration.
  ///   weights  #F of the whole mesh
  ComponentSolver(const Triangulation& mesh, const Eigen::VectorXd& weights,
                  MeshComponent component);

  /// Compilation: takes those of the points that lie in this component. Returns whether it kept
  /// what it could of the compilation before it; very many handles have to be compiled afresh.
  bool compile(const std::vector<BarycentricPoint>& points);
  /// Moves the points to their targets (2×#points of the whole mesh) and writes V (2×#V) [length].
  void update(const Eigen::Matrix2Xd& targets, int refinements, TwoStepSolver::Seconds& seconds,
              Eigen::Matrix2Xd& V);
  /// Sets all rotations to 1. The next compilation keeps nothing.
  void reset();

  const MeshComponent& component() const { return component_; }
  ComponentMotion motion() const { return motion_; }
  /// Writes the intermediate positions (2×#V) [length].
  void write_intermediate(Eigen::Matrix2Xd& intermediate) const;
  /// Writes the corners of the fitted triangles (2×3·#F) [length].
  void write_fitted(Eigen::Matrix2Xd& fitted) const;
  /// Non-zero entries of the factor of step two.
  long nonzeros() const { return mesh_->H_grounded.nonzeros(); }

 private:
  void deform(int refinements, TwoStepSolver::Seconds& seconds);
  Eigen::VectorXcd intermediate() const;
  Eigen::VectorXcd translated() const;
  void write(const Eigen::VectorXcd& z, Eigen::Matrix2Xd& V) const;

  MeshComponent component_;
  std::unique_ptr<RegisteredMesh> mesh_;  // on the heap, because system_ refers to it
  std::vector<int> vertex_;  // vertices of the whole mesh in the registered mesh's order
  ComponentMotion motion_ = ComponentMotion::kNone;
  std::vector<int> target_;               // the column of each handle's target
  std::vector<BarycentricPoint> points_;  // its handles, with the registered mesh's vertices
  std::unique_ptr<HandleSystem> schur_complement_, elimination_;
  bool keeps_handles_ = true;
  HandleSystem* system_ = nullptr;  // one of them; null where handles impose at most one condition
  // Targets q_ and positions z_ are relative to origin_, the first target. So they are exactly 0
  // where all targets are one point.
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  Eigen::VectorXcd q_, z_;
  Eigen::VectorXcd fitted_to_;  // the positions before the last repetition of step two, if refined_
  bool refined_ = false;
};

}  // namespace deformlab
