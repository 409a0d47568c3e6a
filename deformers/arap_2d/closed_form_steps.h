#pragma once

#include <vector>

#include "deformers/arap_2d/component_solver.h"
#include "deformers/arap_2d/two_step_solver.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// The two steps in closed form (Igarashi et al. 2005, sections 4.1 to 4.3), for each connected
/// component of a mesh on its own. Registration and compilation compute all that does not depend on
/// the targets. An update is then a small matrix times the targets and a sum of columns, or half a
/// triangular solve where there are many handles (step one), a rotation for each triangle (fitting)
/// and one triangular solve (step two); it allocates no memory. A compilation keeps the columns of
/// the handles that stay, so that each new handle costs one solve and a removed one none; only
/// where there are very many, it factorizes the matrices of the handles.
class ClosedFormSteps final : public TwoStepSolver {
 public:
  /// Registration.
  ///   weights      #F, the stiffness of each triangle (section 5.2)
  ///   refinements  how often step two is repeated with rotations that are fitted to its own
  ///                result; 0 is the method of the paper, and with many repetitions the result
  ///                becomes a minimum of the as-rigid-as-possible energy
  /// Throws InputError as check_rest_mesh does, and where a matrix is singular.
  ClosedFormSteps(const Triangulation& mesh, const Eigen::VectorXd& weights, int refinements = 0);

  void compile(const std::vector<BarycentricPoint>& points) override;
  void update(const Eigen::Matrix2Xd& targets) override;
  void reset() override;

  const Eigen::Matrix2Xd& positions() const override { return V_; }
  Eigen::Matrix2Xd intermediate() const override;
  Eigen::Matrix2Xd fitted() const override;
  Summary summary() const override;

 private:
  Triangulation mesh_;
  int refinements_;
  bool compiled_ = false;  // since the last reset
  std::vector<ComponentSolver> components_;
  Eigen::Matrix2Xd V_;
};

}  // namespace deformlab
