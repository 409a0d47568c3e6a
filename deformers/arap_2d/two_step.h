#pragma once

#include <vector>

#include "deformers/arap_2d/mesh_part.h"
#include "deformers/arap_2d/two_step_solver.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// The two-step closed form of Igarashi et al. 2005, section 4, for each component of a mesh on its
/// own. All that does not depend on where the handles go is computed before: an update is a small
/// matrix times the targets (step one), a rotation for each triangle (the fit) and one triangular
/// solve (step two). It does not allocate.
class TwoStep final : public TwoStepSolver {
 public:
  /// Registration. Throws InputError for what `check` refuses.
  ///   weights      one a triangle (section 5.2)
  ///   refinements  how often step two is repeated with rotations fitted to its own result; 0 is
  ///                the paper's way, many come to the as-rigid-as-possible energy's minimum
  TwoStep(const Triangulation& mesh, const Eigen::VectorXd& weights, int refinements = 0);

  void compile(const std::vector<BarycentricPoint>& places) override;
  void update(const Eigen::Matrix2Xd& targets) override;
  void reset() override;

  const Eigen::Matrix2Xd& positions() const override { return V_; }
  Eigen::Matrix2Xd intermediate() const override;
  Eigen::Matrix2Xd fitted() const override;
  Summary summary() const override;

 private:
  struct Stages {
    Eigen::Matrix2Xd intermediate, fitted;
  };
  Stages stages() const;

  Triangulation mesh_;
  int refinements_;
  std::vector<MeshPart> parts_;
  Eigen::Matrix2Xd V_;
};

}  // namespace deformlab
