#include "deformers/arap_2d/two_step.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>

#include "deformers/arap_2d/staged_steps.h"
#include "geometry/core/error.h"
#include "tests/support/heap_calls.h"
#include "tests/support/samples.h"

// The closed form, held against the same steps as stages of both general solvers, and the laws that
// it keeps.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kSide = 11;  // vertices

Triangulation sheet() { return shaken_grid(kSide, 5); }

Eigen::VectorXd ones(const Triangulation& mesh) { return Eigen::VectorXd::Ones(mesh.F.cols()); }

// Weights 1 but for some triangles.
Eigen::VectorXd painted(const Triangulation& mesh, double weight) {
  Eigen::VectorXd weights = ones(mesh);
  weights.segment(20, 12).setConstant(weight);
  return weights;
}

Eigen::Matrix2Xd at_rest(const Triangulation& mesh, const std::vector<BarycentricPoint>& places) {
  Eigen::Matrix2Xd result(2, std::ssize(places));
  for (int i = 0; i < std::ssize(places); ++i) result.col(i) = places[i].at(mesh.V);
  return result;
}

// Somewhere else, each place in a way of its own.
Eigen::Matrix2Xd moved(const Triangulation& mesh, const std::vector<BarycentricPoint>& places) {
  Eigen::Matrix2Xd targets = at_rest(mesh, places);
  for (Eigen::Index i = 0; i < targets.cols(); ++i) {
    const auto t = static_cast<double>(i);
    targets.col(i) += Eigen::Vector2d(std::sin(2 * t + 1), 0.7 * std::cos(3 * t));
  }
  return targets;
}

// What users hold shapes by.
struct Case {
  const char* name;
  std::vector<BarycentricPoint> places;
};

std::vector<Case> cases(const Triangulation& mesh) {
  const auto in = [&](int f, double a, double b) {
    return BarycentricPoint{mesh.F.col(f), {a, b, 1 - a - b}};
  };
  std::vector<BarycentricPoint> crowd;
  for (int v = 0; v < 20; ++v) crowd.push_back(BarycentricPoint::at_vertex(6 * v + v % 3));
  std::vector<BarycentricPoint> mixed = crowd;
  for (const int f : {30, 70, 150}) mixed.push_back(in(f, 0.3, 0.2));
  return {
      {"two_vertices", {BarycentricPoint::at_vertex(0), BarycentricPoint::at_vertex(120)}},
      {"three_vertices",
       {BarycentricPoint::at_vertex(0), BarycentricPoint::at_vertex(60),
        BarycentricPoint::at_vertex(117)}},
      {"places", {in(3, 0.2, 0.5), in(100, 0.1, 0.1), in(190, 0.6, 0.3)}},
      {"vertex_and_place", {BarycentricPoint::at_vertex(5), in(150, 0.25, 0.25)}},
      {"one_triangle", {in(80, 0.8, 0.1), in(80, 0.1, 0.8), in(10, 0.3, 0.3)}},
      {"neighbours", {in(80, 0.8, 0.1), in(81, 0.2, 0.3), in(83, 0.4, 0.4), in(4, 0.3, 0.3)}},
      {"on_an_edge", {in(40, 0, 0.4), in(120, 0.5, 0.5), BarycentricPoint::at_vertex(10)}},
      {"twenty_vertices", crowd},
      {"many_of_both", mixed},
  };
}

// Ceres' dogleg begins with the full step, which ends a linear stage; its damping would stop where
// F falls no more in double precision, and so leave 1e-8 of x.
SolverOptions solver(SolverMethod method) {
  return {.method = method, .ceres_trust_region = CeresTrustRegion::kDogleg, .epsilon = 1e-14};
}

TEST(TwoStep, AgreesWithBothGeneralSolversOnEveryStage) {
  const Triangulation mesh = sheet();
  for (const double weight : {1.0, 50.0}) {
    const Eigen::VectorXd weights = painted(mesh, weight);
    for (const auto& [name, places] : cases(mesh)) {
      const Eigen::Matrix2Xd targets = moved(mesh, places);
      TwoStep closed_form(mesh, weights);
      closed_form.compile(places);
      closed_form.update(targets);
      for (const SolverMethod method : {SolverMethod::kGaussNewton, SolverMethod::kCeres}) {
        SCOPED_TRACE(std::string(name) + ", " + std::string(name_of(method)) + ", " +
                     std::to_string(weight));
        StagedSteps stages(mesh, weights, 0, solver(method));
        stages.compile(places);
        stages.update(targets);
        const auto distance = [](const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b) {
          return (a - b).cwiseAbs().maxCoeff();
        };
        EXPECT_LT(distance(closed_form.intermediate(), stages.intermediate()), 1e-9);
        EXPECT_LT(distance(closed_form.fitted(), stages.fitted()), 1e-9);
        EXPECT_LT(distance(closed_form.positions(), stages.positions()), 1e-9);
      }
    }
  }
}

TEST(TwoStep, MeetsItsTargets) {
  const Triangulation mesh = sheet();
  for (const auto& [name, places] : cases(mesh)) {
    TwoStep steps(mesh, ones(mesh));
    steps.compile(places);
    const Eigen::Matrix2Xd targets = moved(mesh, places);
    steps.update(targets);
    for (int i = 0; i < std::ssize(places); ++i) {
      EXPECT_LT((places[i].at(steps.positions()) - targets.col(i)).norm(), 1e-11) << name;
    }
  }
}

TEST(TwoStep, ARigidMotionOfTheHandlesMovesAllRigidly) {
  const Triangulation mesh = sheet();
  const Eigen::Matrix2d Q = Eigen::Rotation2Dd(2.5).toRotationMatrix();
  const Eigen::Vector2d c(7, -4);
  for (const auto& [name, places] : cases(mesh)) {
    TwoStep steps(mesh, painted(mesh, 1e4));
    steps.compile(places);
    steps.update((Q * at_rest(mesh, places)).colwise() + c);
    const Eigen::Matrix2Xd expected = (Q * mesh.V).colwise() + c;
    EXPECT_LT((steps.intermediate() - expected).cwiseAbs().maxCoeff(), 1e-8) << name;
    EXPECT_LT((steps.positions() - expected).cwiseAbs().maxCoeff(), 1e-8) << name;
  }
}

TEST(TwoStep, AMotionOfEverythingAndAnotherUnitChangeNothingElse) {
  const Triangulation mesh = sheet();
  const Eigen::Matrix2d Q = Eigen::Rotation2Dd(1.1).toRotationMatrix();
  const Eigen::Vector2d c(300, -20);
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const auto map = [&](const Eigen::Matrix2Xd& points) -> Eigen::Matrix2Xd {
      return unit * ((Q * points).colwise() + c);
    };
    for (const auto& [name, places] : cases(mesh)) {
      TwoStep steps(mesh, ones(mesh)), other({map(mesh.V), mesh.F}, ones(mesh));
      steps.compile(places);
      other.compile(places);
      const Eigen::Matrix2Xd targets = moved(mesh, places);
      steps.update(targets);
      other.update(map(targets));
      EXPECT_LT((other.positions() - map(steps.positions())).cwiseAbs().maxCoeff(), 1e-9 * unit)
          << name << " " << unit;
    }
  }
}

// Of two handles step one is exactly a similarity (section 7, Figure 19, has the consequence).
TEST(TwoStep, StepOneOfTwoHandlesIsASimilarity) {
  const Triangulation mesh = sheet();
  const std::vector<BarycentricPoint> places{BarycentricPoint::at_vertex(0),
                                             BarycentricPoint::at_vertex(120)};
  TwoStep steps(mesh, ones(mesh));
  steps.compile(places);
  const Eigen::Matrix2Xd p = at_rest(mesh, places), q = moved(mesh, places);
  steps.update(q);
  const auto z = [](const Eigen::Vector2d& v) { return std::complex(v.x(), v.y()); };
  const std::complex<double> s = z(q.col(1) - q.col(0)) / z(p.col(1) - p.col(0));
  const Eigen::Matrix2Xd result = steps.intermediate();
  for (Eigen::Index i = 0; i < mesh.V.cols(); ++i) {
    const std::complex<double> expected = z(q.col(0)) + s * z(mesh.V.col(i) - p.col(0));
    EXPECT_LT(std::abs(z(result.col(i)) - expected), 1e-11);
  }
}

TEST(TwoStep, WithoutAHandleItRestsAndOneMovesItAsItIs) {
  const Triangulation mesh = sheet();
  TwoStep steps(mesh, ones(mesh));
  steps.compile({});
  steps.update(Eigen::Matrix2Xd(2, 0));
  EXPECT_EQ(steps.positions(), mesh.V);
  EXPECT_THAT(steps.notes(), ::testing::ElementsAre(HasSubstr("has no handle")));
  const BarycentricPoint place{mesh.F.col(60), {0.2, 0.3, 0.5}};
  const std::vector<std::vector<BarycentricPoint>> one_place{
      {BarycentricPoint::at_vertex(40)}, {place}, {place, place}};
  for (const auto& places : one_place) {
    steps.compile(places);
    steps.update(at_rest(mesh, places).colwise() + Eigen::Vector2d(1, 2));
    const Eigen::Matrix2Xd expected = mesh.V.colwise() + Eigen::Vector2d(1, 2);
    EXPECT_LT((steps.positions() - expected).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((steps.intermediate() - expected).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_THAT(steps.notes(), ::testing::ElementsAre(HasSubstr("one point only")));
  }
}

TEST(TwoStep, HandlesThatCollapseToAPointComeBack) {
  const Triangulation mesh = sheet();
  for (const auto& [name, places] : cases(mesh)) {
    TwoStep steps(mesh, ones(mesh));
    steps.compile(places);
    const Eigen::Matrix2Xd from = at_rest(mesh, places);
    const Eigen::Vector2d to = from.rowwise().mean();
    for (const double t : {0.5, 0.9, 1.0, 1.0, 0.7, 0.0}) {
      steps.update(((1 - t) * from).colwise() + t * to);
      EXPECT_TRUE(steps.positions().allFinite()) << name;
      EXPECT_TRUE(steps.fitted().allFinite()) << name;
    }
    EXPECT_LT((steps.positions() - mesh.V).cwiseAbs().maxCoeff(), 1e-9) << name;
  }
}

TEST(TwoStep, HandlesInOnePlaceWithSeveralTargetsAreMetOnTheMean) {
  const Triangulation mesh = sheet();
  const BarycentricPoint place{mesh.F.col(60), {0.2, 0.3, 0.5}};
  const std::vector<BarycentricPoint> places{place, place, BarycentricPoint::at_vertex(0)};
  TwoStep steps(mesh, ones(mesh));
  steps.compile(places);
  Eigen::Matrix2Xd targets = at_rest(mesh, places);
  targets.col(0) += Eigen::Vector2d(1, 0);
  targets.col(1) += Eigen::Vector2d(0, 1);
  steps.update(targets);
  const Eigen::Vector2d mean = targets.leftCols<2>().rowwise().mean();
  EXPECT_LT((place.at(steps.positions()) - mean).norm(), 1e-11);
}

// Two sheets side by side, one of them numbered last.
Triangulation two_sheets() {
  const Triangulation one = sheet();
  const auto n = static_cast<int>(one.V.cols());
  Triangulation both{Eigen::Matrix2Xd(2, 2 * n), Eigen::Matrix3Xi(3, 2 * one.F.cols())};
  both.V << one.V, one.V.colwise() + Eigen::Vector2d(5, 0);
  both.F << one.F, one.F.array() + n;
  return both;
}

TEST(TwoStep, APartWithoutAHandleStays) {
  const Triangulation mesh = two_sheets();
  const Eigen::Index n = mesh.V.cols() / 2;
  const std::vector<BarycentricPoint> places{BarycentricPoint::at_vertex(3),
                                             BarycentricPoint::at_vertex(100)};
  TwoStep steps(mesh, ones(mesh));
  steps.compile(places);
  steps.update(moved(mesh, places));
  EXPECT_EQ(steps.positions().rightCols(n), mesh.V.rightCols(n));
  EXPECT_GT((steps.positions() - mesh.V).leftCols(n).norm(), 1);
  EXPECT_THAT(steps.notes(), ::testing::ElementsAre(HasSubstr("the first is vertex 121")));
}

TEST(TwoStep, PartsDoNotFeelEachOther) {
  const Triangulation mesh = two_sheets();
  const std::vector<BarycentricPoint> left{BarycentricPoint::at_vertex(3),
                                           BarycentricPoint::at_vertex(100)};
  std::vector<BarycentricPoint> both = left;
  for (const int v : {130, 180, 230}) both.push_back(BarycentricPoint::at_vertex(v));
  TwoStep one(mesh, ones(mesh)), two(mesh, ones(mesh));
  one.compile(left);
  two.compile(both);
  one.update(moved(mesh, left));
  two.update(moved(mesh, both));
  EXPECT_THAT(two.notes(), IsEmpty());
  EXPECT_EQ(one.positions().leftCols(121), two.positions().leftCols(121));
}

// Two squares that share one corner.
TEST(TwoStep, PartsThatMeetInAVertexHangTogether) {
  Triangulation mesh{Eigen::Matrix2Xd(2, 7), Eigen::Matrix3Xi(3, 4)};
  mesh.V << 0, 1, 1, 0, 2, 2, 1, 0, 0, 1, 1, 1, 2, 2;
  mesh.F << 0, 0, 2, 2, 1, 2, 4, 5, 2, 3, 5, 6;
  const std::vector<BarycentricPoint> places{BarycentricPoint::at_vertex(0),
                                             BarycentricPoint::at_vertex(3)};
  TwoStep steps(mesh, ones(mesh));
  StagedSteps stages(mesh, ones(mesh), 0, solver(SolverMethod::kGaussNewton));
  const Eigen::Matrix2d Q = Eigen::Rotation2Dd(0.8).toRotationMatrix();
  for (TwoStepSolver* both : std::initializer_list<TwoStepSolver*>{&steps, &stages}) {
    both->compile(places);
    both->update(Q * at_rest(mesh, places));
    EXPECT_LT((both->positions() - Q * mesh.V).cwiseAbs().maxCoeff(), 1e-8);
  }
}

double arap(const Triangulation& mesh, const Eigen::Matrix2Xd& V) {
  double energy = 0;
  for (const auto f : mesh.F.colwise()) {
    std::complex<double> s = 0;
    std::array<std::complex<double>, 3> e, e_rest;
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector2d a = V.col(f[(c + 1) % 3]) - V.col(f[c]);
      const Eigen::Vector2d b = mesh.V.col(f[(c + 1) % 3]) - mesh.V.col(f[c]);
      e[c] = {a.x(), a.y()};
      e_rest[c] = {b.x(), b.y()};
      s += std::conj(e_rest[c]) * e[c];
    }
    for (int c = 0; c < 3; ++c) energy += std::norm(e[c] - s / std::abs(s) * e_rest[c]);
  }
  return energy;
}

TEST(TwoStep, RefinementsLowerTheEnergyEachTime) {
  const Triangulation mesh = sheet();
  const auto [name, places] = cases(mesh)[1];
  double last = std::numeric_limits<double>::infinity();
  for (const int refinements : {0, 1, 3, 10, 40}) {
    TwoStep steps(mesh, ones(mesh), refinements);
    StagedSteps stages(mesh, ones(mesh), refinements, solver(SolverMethod::kGaussNewton));
    for (TwoStepSolver* both : std::initializer_list<TwoStepSolver*>{&steps, &stages}) {
      both->compile(places);
      both->update(moved(mesh, places));
    }
    EXPECT_LT((steps.positions() - stages.positions()).cwiseAbs().maxCoeff(), 1e-9);
    const double energy = arap(mesh, steps.positions());
    EXPECT_LT(energy, last) << refinements;
    last = energy;
  }
}

TEST(TwoStep, PaintedTrianglesKeepTheirForm) {
  const Triangulation mesh = sheet();
  const auto [name, places] = cases(mesh)[1];
  std::vector<double> energy;
  Triangulation part = mesh;
  part.F = mesh.F.middleCols<12>(20);
  for (const double weight : {1.0, 1e4}) {
    TwoStep steps(mesh, painted(mesh, weight));
    steps.compile(places);
    steps.update(moved(mesh, places));
    energy.push_back(arap(part, steps.positions()));
  }
  EXPECT_LT(energy[1], 1e-3 * energy[0]);
}

TEST(TwoStep, AnUpdateDoesNotAllocate) {
  const Triangulation mesh = sheet();
  for (const auto& [name, places] : cases(mesh)) {
    TwoStep steps(mesh, ones(mesh), 2);
    steps.compile(places);
    const Eigen::Matrix2Xd targets = moved(mesh, places);
    steps.update(targets);
    const long before = heap_calls;
    steps.update(targets);
    EXPECT_EQ(heap_calls - before, 0) << name;
  }
  const long before = heap_calls;
  const std::vector<double> numbers(100);
  EXPECT_GE(heap_calls - before, 1);  // they are counted
}

std::string refusal(const Triangulation& mesh, const Eigen::VectorXd& weights) {
  try {
    TwoStep(mesh, weights);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TwoStep, RefusesWhatCannotBeDeformed) {
  const Triangulation good = sheet();
  Triangulation mesh = good;
  mesh.V.col(1) = mesh.V.col(0);
  EXPECT_THAT(refusal(mesh, ones(mesh)), HasSubstr("edge of length 0, from vertex 0 to 1"));
  mesh = good;
  mesh.F(0, 0) = 999;
  EXPECT_THAT(refusal(mesh, ones(mesh)), HasSubstr("0 to 120"));
  mesh = good;
  mesh.V.conservativeResize(2, 122);
  mesh.V.col(121).setZero();
  EXPECT_THAT(refusal(mesh, ones(mesh)), HasSubstr("vertex 121 belongs to no triangle"));
  mesh = good;
  mesh.V(0, 7) = std::nan("");
  EXPECT_THAT(refusal(mesh, ones(mesh)), HasSubstr("vertex 7"));
  EXPECT_THAT(refusal({good.V, Eigen::Matrix3Xi(3, 0)}, {}), HasSubstr("no triangle"));
  EXPECT_THAT(refusal(good, Eigen::VectorXd::Ones(3)), HasSubstr("3 weights for 200"));
  Eigen::VectorXd weights = ones(good);
  weights[4] = -1;
  EXPECT_THAT(refusal(good, weights), HasSubstr("triangle 4 is -1"));
  weights[4] = 1e9;
  EXPECT_THAT(refusal(good, weights), HasSubstr("1e6 times"));
}

}  // namespace
}  // namespace deformlab::test
