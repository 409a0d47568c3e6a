#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deformers/arap_2d/two_step_solver.h"
#include "deformers/deformer.h"
#include "geometry/plane/locator.h"
#include "geometry/plane/triangulation.h"
#include "solvers/options.h"

namespace deformlab {

/// What the rigid 2D shape can be told.
struct Arap2dOptions {
  /// closed_form: all that does not depend on the targets is computed before (TwoStep). stages: the
  /// same two steps as stages of a general solver (StagedSteps), to compare with.
  std::string steps = "closed_form";
  /// How often step two is repeated with rotations fitted to its own result. 0 is the paper's; many
  /// come to the minimum of the as-rigid-as-possible energy.
  int refinements = 0;
  /// Of stages. Ceres' dogleg begins with a full step, which ends a linear stage.
  SolverOptions solver = {.ceres_trust_region = "dogleg", .epsilon = 1e-14};

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.choice("steps", o.steps, {"closed_form", "stages"},
                 "closed_form, or stages: the same by a general solver, to compare with");
    visit("refinements", o.refinements,
          "how often step two is repeated with rotations fitted to its result; 0 is the paper's");
    visit("solver", o.solver, "of stages: how each is minimised");
  }
};

/// As-Rigid-As-Possible Shape Manipulation (Igarashi, Moscovich and Hughes 2005) of a triangulation
/// in the plane. Without a handle it stays at rest, one handle moves it without turning it, two or
/// more deform it; so it is for each part of a mesh that is not connected. z is 0 throughout.
class Arap2d final : public Deformer {
 public:
  /// Registration.
  ///   weights  stiffness of each triangle (section 5.2), positive; empty: 1
  /// Throws InputError for a mesh or weights that cannot be deformed, and options out of range.
  Arap2d(const Triangulation& rest, const Eigen::VectorXd& weights, const Arap2dOptions& options);

  /// Handles may be at vertices and anywhere inside; several may share a triangle, as far as its
  /// three corners can follow them. Throws InputError as Deformer says, and for a place outside.
  void compile(const Handles& handles) override;
  Report update(const Eigen::Matrix3Xd& targets) override;
  const Shape& deformed() const override { return deformed_; }
  void reset() override;

  /// 2×#V: step one's result in the last update (Figure 3a) [length].
  Eigen::Matrix2Xd intermediate() const { return steps_->intermediate(); }
  /// 2×3·#F: corners of the triangles fitted to it (Figure 3b) [length].
  Eigen::Matrix2Xd fitted() const { return steps_->fitted(); }
  const TwoStepSolver& steps() const { return *steps_; }

 private:
  BarycentricPoint place_at(const Eigen::Vector2d& point) const;
  void measure_triangles(Report& report) const;

  Triangulation rest_;
  Locator locate_;
  std::unique_ptr<TwoStepSolver> steps_;
  std::vector<BarycentricPoint> places_;  // fixed vertices, moved ones, then points
  Eigen::Index fixed_ = 0;
  Eigen::Matrix2Xd targets_;  // of places_
  Shape deformed_;
  std::map<std::string, double> seconds_;
};

}  // namespace deformlab
