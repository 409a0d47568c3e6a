#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "deformers/arap_2d/connectivity.h"
#include "deformers/arap_2d/two_step_solver.h"
#include "solvers/loss.h"
#include "solvers/problem.h"
#include "solvers/solver.h"

namespace deformlab {

/// What is minimised after the two steps. The paper has no such step; its sections 4 and 7 wish for
/// one.
struct ElasticOptions {
  /// The weight of each elastic term by its name (energies/elastic_catalog.h). Without a weight
  /// above 0 there is no such step.
  std::map<std::string, double> energies;
  std::map<std::string, LossOptions> losses;  ///< by the names of terms
  SolverOptions solver;

  bool is_used() const;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("energies", o.energies,
          "The weights of elastic terms: arap, stretch_shear, area, symmetric_dirichlet");
    visit(
        "losses", o.losses,
        "Robust losses of these terms, with which a few triangles deform more and the others less");
    visit("solver", o.solver, "The solver that minimises the elastic terms");
  }
};

/// Throws InputError for an unknown term and for a weight that is negative or not finite.
void check_elastic(const ElasticOptions& options);

/// The two steps, and then a nonlinear elastic energy that is minimised from their result (Igarashi
/// et al. 2005, sections 4 and 7). Handles at vertices stay where the two steps have put them, and
/// the others are held by point_constraint. Components that only move as a whole stay as they are.
class ElasticSteps final : public TwoStepSolver {
 public:
  ///   weights  #F, the stiffness of each triangle
  ElasticSteps(std::unique_ptr<TwoStepSolver> two_steps, const Triangulation& mesh,
               const Eigen::VectorXd& weights, const ElasticOptions& options);

  void compile(const std::vector<BarycentricPoint>& points) override;
  void update(const Eigen::Matrix2Xd& targets) override;
  void reset() override;

  const Eigen::Matrix2Xd& positions() const override { return V_; }
  Eigen::Matrix2Xd intermediate() const override { return two_steps_->intermediate(); }
  Eigen::Matrix2Xd fitted() const override { return two_steps_->fitted(); }
  Summary summary() const override { return summary_; }

 private:
  void fix_vertices(const std::vector<BarycentricPoint>& points);
  int count_inside_out() const;

  std::unique_ptr<TwoStepSolver> two_steps_;
  Triangulation mesh_;  // in mean edges, around the origin
  Eigen::VectorXd weights_;
  ElasticOptions options_;
  double unit_ = 1;
  Eigen::Vector2d origin_;
  std::vector<MeshComponent> components_;
  std::vector<int> held_;  // the points that are constraints
  std::string oriented_;   // the name of a term that cannot begin with a triangle inside out
  Problem problem_;
  std::unique_ptr<Solver> solver_;
  Eigen::Matrix2Xd V_;
  Summary summary_;
};

}  // namespace deformlab
