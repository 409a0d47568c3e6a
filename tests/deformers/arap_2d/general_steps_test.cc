#include "deformers/arap_2d/general_steps.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <initializer_list>
#include <limits>
#include <string>

#include "deformers/arap_2d/closed_form_steps.h"
#include "tests/deformers/arap_2d/handle_cases.h"

// The two steps by both general solvers, compared with the closed form.
namespace deformlab::test {
namespace {

// Ceres' dogleg begins with the full step, which solves a linear problem. Its damped steps would
// stop where F does not fall any more in double precision, which leaves an error of 1e-8 in x.
SolverOptions solver(SolverMethod method) {
  return {.method = method, .ceres_trust_region = CeresTrustRegion::kDogleg, .epsilon = 1e-14};
}

TEST(GeneralSteps, AgreeWithTheClosedFormInEveryStep) {
  const Triangulation mesh = square();
  for (const double weight : {1.0, 50.0}) {
    const Eigen::VectorXd weights = painted(mesh, weight);
    for (const auto& [name, points] : handle_cases(mesh)) {
      const Eigen::Matrix2Xd targets = moved(mesh, points);
      ClosedFormSteps closed_form(mesh, weights);
      closed_form.compile(points);
      closed_form.update(targets);
      for (const SolverMethod method : {SolverMethod::kGaussNewton, SolverMethod::kCeres}) {
        // With so large residuals, Ceres ends where F does not fall any more, at errors of 1e-8.
        if (method == SolverMethod::kCeres && points.size() > 30) continue;
        SCOPED_TRACE(std::string(name) + ", " + std::string(name_of(method)) + ", " +
                     std::to_string(weight));
        GeneralSteps general(mesh, weights, 0, solver(method));
        general.compile(points);
        general.update(targets);
        const auto distance = [](const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b) {
          return (a - b).cwiseAbs().maxCoeff();
        };
        EXPECT_LT(distance(closed_form.intermediate(), general.intermediate()), 1e-9);
        EXPECT_LT(distance(closed_form.fitted(), general.fitted()), 1e-9);
        EXPECT_LT(distance(closed_form.positions(), general.positions()), 1e-9);
      }
    }
  }
}

// Two squares that share one corner.
TEST(GeneralSteps, KeepPartsTogetherThatMeetInAVertexAsTheClosedFormDoes) {
  Triangulation mesh{Eigen::Matrix2Xd(2, 7), Eigen::Matrix3Xi(3, 4)};
  mesh.V << 0, 1, 1, 0, 2, 2, 1, 0, 0, 1, 1, 1, 2, 2;
  mesh.F << 0, 0, 2, 2, 1, 2, 4, 5, 2, 3, 5, 6;
  const std::vector<BarycentricPoint> points{BarycentricPoint::at_vertex(0),
                                             BarycentricPoint::at_vertex(3)};
  ClosedFormSteps steps(mesh, ones(mesh));
  GeneralSteps general(mesh, ones(mesh), 0, solver(SolverMethod::kGaussNewton));
  const Eigen::Matrix2d Q = Eigen::Rotation2Dd(0.8).toRotationMatrix();
  for (TwoStepSolver* both : std::initializer_list<TwoStepSolver*>{&steps, &general}) {
    both->compile(points);
    both->update(Q * at_rest(mesh, points));
    EXPECT_LT((both->positions() - Q * mesh.V).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(GeneralSteps, LowerTheEnergyByEachRefinementAsTheClosedFormDoes) {
  const Triangulation mesh = square();
  const auto [name, points] = handle_cases(mesh)[1];
  double last = std::numeric_limits<double>::infinity();
  for (const int refinements : {0, 1, 3, 10, 40}) {
    ClosedFormSteps steps(mesh, ones(mesh), refinements);
    GeneralSteps general(mesh, ones(mesh), refinements, solver(SolverMethod::kGaussNewton));
    for (TwoStepSolver* both : std::initializer_list<TwoStepSolver*>{&steps, &general}) {
      both->compile(points);
      both->update(moved(mesh, points));
    }
    EXPECT_LT((steps.positions() - general.positions()).cwiseAbs().maxCoeff(), 1e-9);
    const double energy = arap_energy(mesh, steps.positions());
    EXPECT_LT(energy, last) << refinements;
    last = energy;
  }
}

}  // namespace
}  // namespace deformlab::test
