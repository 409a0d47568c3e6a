#pragma once

#include <memory>
#include <vector>

#include "deformers/arap_2d/component_motion.h"
#include "deformers/arap_2d/connectivity.h"
#include "deformers/arap_2d/handle_clusters.h"
#include "deformers/arap_2d/two_step_solver.h"
#include "solvers/solver.h"

namespace deformlab {

/// The two steps of Igarashi et al. 2005 as they are printed: three problems of registered terms
/// (similarity, then fitting, then edge_fit), which a general solver minimises one after another.
/// This is many times slower than ClosedFormSteps. As it is independent, each verifies the other.
///
/// A handle at a vertex is eliminated. Another handle, or one that shares a triangle with others,
/// is a point_constraint. Its target is shifted until the point itself meets the target (the method
/// of multipliers), so that the result does not depend on the weight of the constraint.
class GeneralSteps final : public TwoStepSolver {
 public:
  /// Registration, with arguments as for ClosedFormSteps.
  /// Throws InputError as check_rest_mesh does, and for options that make_solver refuses.
  GeneralSteps(const Triangulation& mesh, const Eigen::VectorXd& weights, int refinements,
               const SolverOptions& solver);

  void compile(const std::vector<BarycentricPoint>& points) override;
  void update(const Eigen::Matrix2Xd& targets) override;
  void reset() override;

  const Eigen::Matrix2Xd& positions() const override { return V_; }
  Eigen::Matrix2Xd intermediate() const override { return to_lengths(similarity_.problem.x.X); }
  Eigen::Matrix2Xd fitted() const override { return to_lengths(corners_); }
  Summary summary() const override { return summary_; }

 private:
  struct Step {
    Problem problem;
    std::unique_ptr<Solver> solver;
  };
  // A vertex and the handles that are at it.
  struct VertexHandles {
    int vertex;
    std::vector<int> handles;
  };
  // A component that cannot deform. It is translated, or stays at rest where it has no handle.
  struct TranslatedComponent {
    std::vector<int> vertices, handles;
    Eigen::Vector2d center;  // the mean of its handles at rest [mean edge]
  };

  Eigen::Matrix2Xd to_lengths(const Eigen::MatrixXd& X) const {
    return (unit_ * X).colwise() + origin_;
  }
  void fix_translated_components(const std::vector<BarycentricPoint>& points);
  void add_cluster(const std::vector<BarycentricPoint>& points, const HandleCluster& cluster);
  void compile_problems();
  void translate_components(const Eigen::Matrix2Xd& q);
  void solve_with_handles(Step& step, const Eigen::Matrix2Xd& q);
  void fit(const Eigen::MatrixXd& intermediate);
  void solve(Step& step);

  double unit_;             // the mean edge [length], the unit of all but origin_ and V_
  Eigen::Vector2d origin_;  // the mean of the vertices [length]
  Triangulation mesh_;      // at rest, relative to origin_
  Eigen::VectorXd weights_;
  int refinements_;
  std::vector<MeshComponent> components_;

  Step similarity_, fitting_, edge_fit_;
  std::vector<char> fixed_;  // #V, the vertices that are eliminated from both steps
  std::vector<VertexHandles> vertex_handles_;
  std::vector<TranslatedComponent> translated_;
  std::vector<BarycentricPoint> points_;  // the handles that are constraints
  std::vector<int> target_;               // the column of the target of each of points_

  Eigen::VectorXcd R_;        // #F rotations of the fitted triangles
  Eigen::Matrix2Xd corners_;  // 2×3·#F corners of the fitted triangles
  Eigen::Matrix2Xd V_;        // the result [length]
  Summary summary_;
};

}  // namespace deformlab
