#pragma once

#include <array>
#include <memory>
#include <vector>

#include "deformers/arap_2d/two_step_solver.h"
#include "deformers/deformer.h"
#include "geometry/plane/locator.h"
#include "geometry/plane/triangulation.h"
#include "solvers/options.h"

namespace deformlab {

/// How the two steps are computed. closed_form: all that does not depend on the targets is computed
/// before (TwoStep). stages: the same two steps are minimised by a general solver (StagedSteps), to
/// compare with.
enum class TwoStepMethod { kClosedForm, kStages };
constexpr auto names_of(TwoStepMethod) {
  using enum TwoStepMethod;
  return std::to_array<EnumName<TwoStepMethod>>(
      {{kClosedForm, "closed_form"}, {kStages, "stages"}});
}

/// The options of as-rigid-as-possible manipulation of drawings.
struct Arap2dOptions {
  TwoStepMethod steps = TwoStepMethod::kClosedForm;
  /// How often step two is repeated with rotations that are fitted to its own result. The paper
  /// does not repeat it; many repetitions come to the minimum of the as-rigid-as-possible energy.
  int refinements = 0;
  /// Of `stages`. Ceres' dogleg begins with a full step, which solves a linear problem at once.
  SolverOptions solver = {.ceres_trust_region = CeresTrustRegion::kDogleg, .epsilon = 1e-14};

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit(
        "steps", o.steps,
        "How the two steps of the method are computed: in closed form, or as stages that a general "
        "solver minimises, to compare with");
    visit.range("refinements", o.refinements, {.min = 0, .max = 100'000},
                "How often step two is repeated with rotations fitted to its own result; the paper "
                "does not repeat it");
    visit("solver", o.solver, "The solver that minimises the stages");
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
