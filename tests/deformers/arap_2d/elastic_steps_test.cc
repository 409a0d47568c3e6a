#include "deformers/arap_2d/elastic_steps.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <utility>

#include "deformers/arap_2d/arap_2d.h"
#include "deformers/arap_2d/closed_form_steps.h"
#include "energies/elastic_catalog.h"
#include "energies/triangle/gradient.h"
#include "geometry/core/error.h"
#include "tests/deformers/arap_2d/handle_cases.h"

// The nonlinear energies that are minimised after the two steps.
namespace deformlab::test {
namespace {

ElasticOptions options(const std::string& term, SolverMethod method = SolverMethod::kGaussNewton) {
  ElasticOptions result{{{term, 1}}, {}, {}};
  result.solver.method = method;
  result.solver.epsilon = 1e-10;
  return result;
}

ElasticSteps make(const Triangulation& mesh, const ElasticOptions& options) {
  return {std::make_unique<ClosedFormSteps>(mesh, ones(mesh)), mesh, ones(mesh), options};
}

// The left edge stays, and the right one goes to the right by `pull`.
struct Pull {
  std::vector<BarycentricPoint> points;
  Eigen::Matrix2Xd targets;

  Pull(const Triangulation& mesh, double pull) {
    const double left = mesh.V.row(0).minCoeff(), right = mesh.V.row(0).maxCoeff();
    const double margin = (right - left) / 20;
    for (int v = 0; v < mesh.V.cols(); ++v) {
      const double x = mesh.V(0, v);
      if (x > left + margin && x < right - margin) continue;
      points.push_back(BarycentricPoint::at_vertex(v));
      targets.conservativeResize(2, targets.cols() + 1);
      targets.rightCols<1>() = mesh.V.col(v) + Eigen::Vector2d(x > left + margin ? pull : 0, 0);
    }
  }
};

TEST(ElasticSteps, BothSolversFindTheSameMinimum) {
  const Triangulation mesh = square();
  for (const ElasticTerm& term : known_elastic_terms()) {
    SCOPED_TRACE(term.name);
    const Pull pull(mesh, 0.4);
    double cost[2];
    for (const SolverMethod method : {SolverMethod::kGaussNewton, SolverMethod::kCeres}) {
      ElasticOptions its = options(term.name, method);
      if (term.name == "area") its.energies["arap"] = 1;  // alone it has many minima
      ElasticSteps steps = make(mesh, its);
      steps.compile(pull.points);
      steps.update(pull.targets);
      const Summary solve = steps.summary();
      EXPECT_NE(solve.status, Status::kFailed) << solve.message;
      EXPECT_LT(solve.final_cost, solve.initial_cost);
      cost[method == SolverMethod::kCeres] = solve.final_cost;
      for (std::size_t l = 0; l < pull.points.size(); ++l) {
        EXPECT_LT((pull.points[l].at(steps.positions()) - pull.targets.col(l)).norm(), 1e-12);
      }
    }
    EXPECT_NEAR(cost[1] / cost[0], 1, 1e-7);
  }
}

TEST(ElasticSteps, HandlesInsideTrianglesArrive) {
  const Triangulation mesh = square();
  for (const auto& [name, points] : handle_cases(mesh)) {
    SCOPED_TRACE(name);
    ElasticSteps steps = make(mesh, options("arap"));
    ClosedFormSteps two_steps(mesh, ones(mesh));
    steps.compile(points);
    two_steps.compile(points);
    const Eigen::Matrix2Xd targets = moved(mesh, points);
    steps.update(targets);
    two_steps.update(targets);
    for (int l = 0; l < std::ssize(points); ++l) {
      const double before = (points[l].at(two_steps.positions()) - targets.col(l)).norm();
      EXPECT_LT((points[l].at(steps.positions()) - targets.col(l)).norm(), before + 1e-4);
    }
  }
}

TEST(ElasticSteps, WithoutMotionNothingMovesAndARotationCostsNothing) {
  const Triangulation mesh = square();
  const Pull pull(mesh, 0);
  const Eigen::Matrix2d Q = Eigen::Rotation2Dd(2).toRotationMatrix();
  for (const ElasticTerm& term : known_elastic_terms()) {
    ElasticSteps steps = make(mesh, options(term.name));
    steps.compile(pull.points);
    steps.update(Q * pull.targets);
    EXPECT_LT(steps.summary().final_cost, 1e-12) << term.name;
    EXPECT_TRUE(steps.positions().isApprox(Q * mesh.V, 1e-9)) << term.name;
  }
}

TEST(ElasticSteps, SymmetricDirichletTurnsNoTriangleInsideOut) {
  const Triangulation mesh = square();
  const Pull pull(mesh, -0.6);  // of a width of 3
  for (const SolverMethod method : {SolverMethod::kGaussNewton, SolverMethod::kCeres}) {
    Arap2dOptions its;
    its.elastic = options("symmetric_dirichlet", method);
    Arap2d deformer(mesh, {}, its);
    Handles handles;
    for (const BarycentricPoint& point : pull.points) handles.moved.push_back(point.vertices[0]);
    deformer.compile(handles);
    Eigen::Matrix3Xd targets = Eigen::Matrix3Xd::Zero(3, pull.targets.cols());
    targets.topRows<2>() = pull.targets;
    const Report report = deformer.update(targets);
    EXPECT_NE(report.solve.status, Status::kFailed) << report.solve.message;
    EXPECT_EQ(report.inside_out, 0);
    EXPECT_GT(report.min_det_R, 0);
  }
}

TEST(ElasticSteps, ATermThatCannotBeginInsideOutSaysSo) {
  const Triangulation mesh = square();
  const Pull pull(mesh, -3);  // beyond the other side
  ElasticSteps steps = make(mesh, options("symmetric_dirichlet"));
  steps.compile(pull.points);
  steps.update(pull.targets);
  EXPECT_EQ(steps.summary().status, Status::kFailed);
  EXPECT_NE(steps.summary().message.find("symmetric_dirichlet cannot begin"), std::string::npos)
      << steps.summary().message;
}

TEST(ElasticSteps, AComponentThatIsOnlyMovedStaysAsTheTwoStepsLeaveIt) {
  const Triangulation mesh = square();
  ElasticSteps steps = make(mesh, options("arap"));
  const Eigen::Vector2d way(3, 4);
  steps.compile({BarycentricPoint::at_vertex(0)});
  steps.update(mesh.V.col(0) + way);
  EXPECT_TRUE(steps.positions().isApprox(mesh.V.colwise() + way, 1e-12));
  EXPECT_EQ(steps.compilations(), 1) << "they are always compiled afresh";
  steps.reset();
  EXPECT_EQ(steps.positions(), mesh.V);
}

TEST(ElasticSteps, RefusesWhatItDoesNotKnow) {
  const Triangulation mesh = square();
  Arap2dOptions its;
  its.elastic.energies = {{"arp", 1}};
  EXPECT_THROW(Arap2d(mesh, {}, its), InputError);
  its.elastic.energies = {{"arap", -1}};
  EXPECT_THROW(Arap2d(mesh, {}, its), InputError);
  its.elastic.energies = {{"arap", 1}};
  its.elastic.losses = {{"areas", {}}};
  EXPECT_THROW(Arap2d(mesh, {}, its), InputError);
}

// A term of a user: the length of a triangle's first edge.
struct FirstEdge {
  static constexpr std::string_view kName = "first_edge";
  RestTriangle rest;
  template <class T>
  Vector<T, 1> operator()(const Vector<T, 2>& v0, const Vector<T, 2>& v1,
                          const Vector<T, 2>&) const {
    return Vector<T, 1>((v1 - v0).squaredNorm() - T(rest.inverse.inverse().col(0).squaredNorm()));
  }
  static Terms<FirstEdge> over(const Triangulation& mesh, const Eigen::VectorXd& weights) {
    return over_triangles<FirstEdge>(mesh, weights);
  }
};

TEST(ElasticSteps, TakeATermOfYourOwn) {
  register_elastic_term<FirstEdge>();
  EXPECT_THROW(register_elastic_term<FirstEdge>(), InputError);
  const Triangulation mesh = square();
  const Pull pull(mesh, 0.4);
  ElasticOptions its = options("first_edge");
  its.energies["arap"] = 0.1;
  ElasticSteps steps = make(mesh, its);
  steps.compile(pull.points);
  steps.update(pull.targets);
  EXPECT_GT(steps.summary().cost_by_term.at("first_edge"), 0);
}

}  // namespace
}  // namespace deformlab::test
