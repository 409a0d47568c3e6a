#pragma once

#include <memory>
#include <vector>

#include "deformers/arap_2d/connectivity.h"
#include "deformers/arap_2d/mesh_part.h"
#include "deformers/arap_2d/two_step_solver.h"
#include "solvers/solver.h"

namespace deformlab {

/// The two steps of Igarashi et al. 2005 as they are printed: three problems of registered terms,
/// each minimised by a general solver (similarity, then fitting, then edge_fit). Many times slower
/// than TwoStep and independent of it, so that the two can be held against each other.
///
/// A handle at a vertex is eliminated. One that is no vertex, or shares a triangle with others, is
/// a point_constraint whose target is shifted until the place itself is met (the method of
/// multipliers): the result does not depend on the constraint's weight.
class StagedSteps final : public TwoStepSolver {
 public:
  /// Throws InputError as TwoStep does, and for options that make_solver refuses.
  StagedSteps(const Triangulation& mesh, const Eigen::VectorXd& weights, int refinements,
              const SolverOptions& solver);

  void compile(const std::vector<BarycentricPoint>& places) override;
  void update(const Eigen::Matrix2Xd& targets) override;
  void reset() override;

  const Eigen::Matrix2Xd& positions() const override { return V_; }
  Eigen::Matrix2Xd intermediate() const override { return to_lengths(similarity_.problem.x.X); }
  Eigen::Matrix2Xd fitted() const override { return to_lengths(corners_); }
  Summary summary() const override { return summary_; }

  /// What minimises step one, the fit and step two; lengths in mean edges.
  const Problem& similarity() const { return similarity_.problem; }
  const Problem& fitting() const { return fitting_.problem; }
  const Problem& edges() const { return edges_.problem; }

 private:
  struct Solved {
    Problem problem;
    std::unique_ptr<Solver> solver;
  };
  // One vertex, and the places that are that vertex.
  struct HeldVertex {
    int vertex;
    std::vector<int> places;
  };
  // A part that is held at one place at most, and moves as a whole.
  struct Carried {
    std::vector<int> vertices, places;
    Eigen::Vector2d at;  // of the places at rest, on the mean
  };

  Eigen::Matrix2Xd to_lengths(const Eigen::MatrixXd& X) const {
    return (unit_ * X).colwise() + origin_;
  }
  void hold_parts(const std::vector<BarycentricPoint>& places);
  void hold(const std::vector<BarycentricPoint>& places, const Cluster& cluster);
  void put_terms();
  void carry(const Eigen::Matrix2Xd& q);
  void put_held(const Eigen::Matrix2Xd& q, Unknowns& x) const;
  void solve_held(Solved& step, const Eigen::Matrix2Xd& q);
  void fit(const Eigen::MatrixXd& intermediate);
  void solve(Solved& step);

  double unit_;             // the mean edge [length]
  Eigen::Vector2d origin_;  // the mean vertex [length]
  Triangulation mesh_;      // at rest, in unit_ from origin_
  Eigen::VectorXd weights_;
  int refinements_;
  std::vector<MeshComponent> components_;

  Solved similarity_, fitting_, edges_;
  std::vector<char> held_;  // #V
  std::vector<HeldVertex> held_vertices_;
  std::vector<Carried> carried_;
  std::vector<BarycentricPoint> places_;  // that are no vertices
  std::vector<int> place_;                // of places_ among all

  Eigen::VectorXcd R_;        // of each triangle's fit
  Eigen::Matrix2Xd corners_;  // 2×3·#F of the fitted triangles
  Eigen::Matrix2Xd V_;        // the result [length]
  Summary summary_;
};

}  // namespace deformlab
