#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "deformers/arap_2d/connectivity.h"
#include "deformers/arap_2d/handle_points.h"
#include "deformers/arap_2d/handle_system.h"
#include "deformers/arap_2d/two_step_solver.h"

namespace deformlab {

/// How a connected mesh is held, which decides what its two steps are.
enum class Hold {
  kFree,   ///< by no place: it stays at rest
  kPoint,  ///< at one place: it moves there without turning
  kShape,  ///< at two places or more
};

/// What the user should know about components that are held at fewer than two places; the first
/// few by name, the others counted.
class HoldNotes {
 public:
  void add(const MeshComponent& component, Hold hold);
  std::vector<std::string> notes() const;

 private:
  std::vector<std::string> named_;
  int others_ = 0;
};

/// Whether places differ at rest positions p, measured against the extent of p.
bool differ(const std::vector<BarycentricPoint>& places, const Eigen::VectorXcd& p);

/// One component of a mesh under TwoStep. Whole meshes go in and out; of their columns it reads and
/// writes its own. A part that is free writes nothing.
class MeshPart {
 public:
  MeshPart(const Triangulation& mesh, const Eigen::VectorXd& weights, MeshComponent component);

  /// Of all places those that lie in this component.
  void compile(const std::vector<BarycentricPoint>& places);
  /// Takes them to their targets (2×k, of all places) and writes its own columns of V (2×#V).
  void update(const Eigen::Matrix2Xd& targets, int refinements, TwoStepSolver::Seconds& seconds,
              Eigen::Matrix2Xd& V);
  void reset() { mesh_->fit.reset(); }

  const MeshComponent& component() const { return component_; }
  Hold hold() const { return hold_; }
  /// Its own columns of 2×#V intermediate positions and 2×3·#F corners of fitted triangles.
  void write_stages(Eigen::Matrix2Xd& intermediate, Eigen::Matrix2Xd& fitted) const;
  long nonzeros() const { return mesh_->H_grounded.nonzeros(); }

 private:
  Eigen::VectorXcd carried() const;
  void write(const Eigen::VectorXcd& z, Eigen::Matrix2Xd& V) const;

  MeshComponent component_;
  std::unique_ptr<RegisteredMesh> mesh_;  // stays where it is: system_ refers to it
  std::vector<int> vertex_;  // of the whole mesh, by place in the registered mesh's order
  Hold hold_ = Hold::kFree;
  bool turns_ = false;
  std::vector<int> index_;                // of its places among all
  std::vector<BarycentricPoint> places_;  // in the registered mesh's order
  std::unique_ptr<HandleSystem> system_;
  // Targets and positions from origin_, the first target: where all targets are one, they are 0.
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  Eigen::VectorXcd q_, z_;
};

}  // namespace deformlab
