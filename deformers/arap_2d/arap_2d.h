#pragma once

#include <array>
#include <memory>
#include <vector>

#include "deformers/arap_2d/elastic_steps.h"
#include "deformers/arap_2d/two_step_solver.h"
#include "deformers/deformer.h"
#include "geometry/plane/locator.h"
#include "geometry/plane/triangulation.h"
#include "solvers/options.h"

namespace deformlab {

/// How the two steps are computed: in closed form (ClosedFormSteps), or by a general solver that
/// minimises the same two steps (GeneralSteps), for comparison.
enum class TwoStepMethod { kClosedForm, kGeneralSolver };
constexpr auto names_of(TwoStepMethod) {
  using enum TwoStepMethod;
  return std::to_array<EnumName<TwoStepMethod>>(
      {{kClosedForm, "closed_form"}, {kGeneralSolver, "general_solver"}});
}

/// The options of as-rigid-as-possible manipulation of drawings.
struct Arap2dOptions {
  TwoStepMethod steps = TwoStepMethod::kClosedForm;
  /// How often step two is repeated with rotations that are fitted to its own result. The paper
  /// does not repeat it. Many repetitions reach a minimum of the as-rigid-as-possible energy.
  int refinements = 0;
  /// The options of kGeneralSolver. Ceres' dogleg begins with a full step, which solves a linear
  /// problem at once.
  SolverOptions solver = {.ceres_trust_region = CeresTrustRegion::kDogleg, .epsilon = 1e-14};
  /// An energy that is minimised after the two steps.
  ElasticOptions elastic{};

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("steps", o.steps,
          "How the two steps of the method are computed: in closed form, or as problems that a "
          "general "
          "solver minimises, to compare with");
    visit.range("refinements", o.refinements, {.min = 0, .max = 100'000},
                "How often step two is repeated with rotations fitted to its own result; the paper "
                "does not repeat it");
    visit("solver", o.solver, "The solver that minimises the problems of the two steps");
    visit("elastic", o.elastic,
          "A nonlinear energy over the triangles that is minimised after the two steps");
  }
};

/// As-Rigid-As-Possible Shape Manipulation (Igarashi, Moscovich and Hughes 2005) of a triangulation
/// in the plane. Each connected component of the mesh stays at rest without a handle, is translated
/// by one handle, and is deformed by two or more. The coordinate z is always 0.
class Arap2d final : public Deformer {
 public:
  /// Registration.
  ///   weights  #F, the positive stiffness of each triangle (section 5.2); empty means 1 for all
  /// Throws InputError for a mesh or weights that the method cannot use (check_rest_mesh), and for
  /// options out of range.
  Arap2d(const Triangulation& rest, const Eigen::VectorXd& weights, const Arap2dOptions& options);

  /// Compilation. Handles may be at vertices and at any point inside the shape. Several handles may
  /// share a triangle; where its three corners cannot follow all of them, they meet their targets
  /// in the least-squares sense. Throws InputError as Deformer says, and for a point outside the
  /// shape.
  void compile(const Handles& handles) override;
  /// Update. Report::min_det_R is over the triangles: the determinant of the map from a triangle at
  /// rest to the deformed one.
  Report update(const Eigen::Matrix3Xd& targets) override;
  const Shape& deformed() const override { return deformed_; }
  void reset() override;

  /// How many times all handles were compiled. Where handles were added, removed or put elsewhere,
  /// `compile` only adapts what it has, unless `reset` was called before, the steps are those of a
  /// general solver, or there are very many handles (more than about 5 ∛#V).
  int compilations() const { return steps_->compilations(); }

  /// 2×#V: the result of step one in the last update (Figure 3a) [length].
  Eigen::Matrix2Xd intermediate() const { return steps_->intermediate(); }
  /// 2×3·#F: the corners of the fitted triangles (Figure 3b) [length].
  Eigen::Matrix2Xd fitted() const { return steps_->fitted(); }

 private:
  BarycentricPoint locate_inside(const Eigen::Vector2d& point) const;
  void measure_triangles(Report& report) const;

  Triangulation rest_;
  Locator locate_;
  std::unique_ptr<TwoStepSolver> steps_;
  std::vector<BarycentricPoint> points_;  // the handles: fixed vertices, moved ones, then points
  Eigen::Index fixed_ = 0;                // the number of fixed vertices
  Eigen::Matrix2Xd targets_;              // 2×#points [length]
  Shape deformed_;
  std::map<std::string, double> seconds_;
};

}  // namespace deformlab
