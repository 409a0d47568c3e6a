#include <gtest/gtest.h>

#include "deformers/embedded/embedded_deformation.h"
#include "tests/support/shapes.h"

// A scene like the one that solvers are measured on, with sides of several lengths in its own unit:
// the shorter they are, the stiffer E_rot beside the other terms.
namespace deformlab::test {
namespace {

struct Scene {
  Shape shape;
  Handles handles;
  Eigen::Matrix3Xd targets;
};

Scene lifted_plane(double side) {
  constexpr int n = 101, strip = 5;
  Scene scene;
  scene.shape = bumpy_plane(n);
  for (int i = 0; i < n * n; ++i) {
    if (i % n < strip || i % n >= n - strip) scene.handles.moved.push_back(i);
  }
  scene.targets = scene.shape.V(Eigen::all, scene.handles.moved);
  for (auto target : scene.targets.colwise()) target.z() += target.x() > 0.5 ? 0.5 : 0;
  scene.shape.V *= side;
  scene.targets *= side;
  return scene;
}

Summary solve(const Scene& scene, int nodes, const std::string& unit, const std::string& solver,
              const std::string& globalization) {
  EmbeddedDeformationOptions options;
  options.graph.nodes = nodes;
  options.length_unit = unit;
  options.solver.linear_solver = solver;
  options.solver.globalization = globalization;
  EmbeddedDeformation deformation(scene.shape, options);
  deformation.compile(scene.handles);
  return deformation.update(scene.targets).solve;
}

class Reference : public ::testing::TestWithParam<std::tuple<int, double>> {
 protected:
  int nodes() const { return std::get<0>(GetParam()); }
  Scene scene() const { return lifted_plane(std::get<1>(GetParam())); }
};

// The default arrives wherever the others do, in no more steps than the better of two and two more,
// and at the same minimum as a factorization.
TEST_P(Reference, TheDefaultArrives) {
  const Summary halved = solve(scene(), nodes(), "1", "cholmod", "line_search");
  const Summary damped = solve(scene(), nodes(), "1", "cholmod", "levenberg");
  const std::size_t best = std::min(halved.iterations.size(), damped.iterations.size());
  for (const char* solver : {"cholmod", "kronecker_cg"}) {
    const Summary s = solve(scene(), nodes(), "1", solver, SolverOptions{}.globalization);
    EXPECT_EQ(s.status, Status::kConverged) << solver;
    EXPECT_LE(s.iterations.size(), best + 2) << solver;
    EXPECT_LE(s.final_cost, (1 + 1e-6) * std::min(halved.final_cost, damped.final_cost)) << solver;
  }
}

INSTANTIATE_TEST_SUITE_P(Sides, Reference,
                         ::testing::Combine(::testing::Values(221, 425, 1048),
                                            ::testing::Values(2, 20)));

TEST(ReferenceScene, ConjugateGradientsFindTheMinimumOfAFactorization) {
  const Scene scene = lifted_plane(1);
  for (const int nodes : {221, 425, 1048}) {
    const Summary direct = solve(scene, nodes, "mean_edge", "cholmod", "accelerated");
    const Summary s = solve(scene, nodes, "mean_edge", "auto", "accelerated");
    EXPECT_EQ(s.linear_solver, "kronecker_cg");
    EXPECT_NEAR(s.final_cost, direct.final_cost, 1e-6 * direct.final_cost) << nodes;
  }
}

// The shape is large enough to be transferred in several pieces. Conjugate gradients use one
// thread.
TEST(ReferenceScene, TheBytesDoNotDependOnTheThreads) {
  const Scene scene = lifted_plane(1);
  for (const auto& [method, linear_solver] : {std::pair(SolverMethod::kGaussNewton, "kronecker_cg"),
                                              std::pair(SolverMethod::kGaussNewton, "cholmod"),
                                              std::pair(SolverMethod::kCeres, "auto")}) {
    EmbeddedDeformationOptions options;
    options.graph.nodes = 1500;
    options.solver.method = method;
    options.solver.linear_solver = linear_solver;
    const auto deform = [&](int threads) {
      options.solver.threads = options.transfer_threads = threads;
      EmbeddedDeformation deformation(scene.shape, options);
      deformation.compile(scene.handles);
      const int used = deformation.update(scene.targets).solve.threads;
      EXPECT_EQ(used, options.solver.linear_solver == "kronecker_cg" ? 1 : threads);
      return deformation.deformed().V;
    };
    const Eigen::Matrix3Xd one = deform(1), two = deform(2);
    const double apart = (one - two).cwiseAbs().maxCoeff();
    // Ceres sums the gradient thread by thread, and so rounds it otherwise.
    EXPECT_LE(apart, options.solver.method == SolverMethod::kCeres ? 1e-12 : 0) << linear_solver;
  }
}

}  // namespace
}  // namespace deformlab::test
