#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "deformers/arap_2d/closed_form_steps.h"
#include "deformers/arap_2d/handle_system.h"
#include "tests/deformers/arap_2d/handle_cases.h"

// A compilation keeps what it can of the one before it, which changes no result.
namespace deformlab::test {
namespace {

#ifdef DEFORMLAB_SANITIZED
constexpr int kEdits = 100;  // these take ten times as long
#else
constexpr int kEdits = 1000;
#endif

// Adds, removes and moves handles at random: vertices, points inside triangles, and pairs of points
// that hold an angle, which come and go together. The number of handles rises and falls between 0
// and `most`.
class RandomHandles {
 public:
  RandomHandles(const Triangulation& mesh, std::ptrdiff_t most) : mesh_(mesh), most_(most) {}

  void next() {
    const auto count = std::ssize(groups_);
    if (count == 0) rises_ = true;
    if (count == most_) rises_ = false;
    const int kind = below(10);
    if (kind < 3 && count > 0) {
      groups_[below(count)] = any();
    } else if (count == 0 || (count < most_ && (kind < 8) == rises_)) {
      groups_.insert(groups_.begin() + below(count + 1), any());
    } else {
      groups_.erase(groups_.begin() + below(count));
    }
  }

  std::vector<BarycentricPoint> points() const {
    std::vector<BarycentricPoint> result;
    for (const auto& group : groups_) result.insert(result.end(), group.begin(), group.end());
    return result;
  }

 private:
  int below(std::ptrdiff_t n) { return static_cast<int>(random_() % n); }
  BarycentricPoint inside() {
    const double a = 0.1 * below(6), b = 0.1 * below(5);
    return {mesh_.F.col(below(mesh_.F.cols())), {a, b, 1 - a - b}};
  }
  std::vector<BarycentricPoint> any() {
    const int kind = below(4);
    if (kind == 0) return {inside()};
    if (kind == 1) return {inside(), inside()};
    return {BarycentricPoint::at_vertex(below(mesh_.V.cols()))};
  }

  std::mt19937 random_{1};
  Triangulation mesh_;
  std::ptrdiff_t most_;
  bool rises_ = true;
  std::vector<std::vector<BarycentricPoint>> groups_;
};

// Targets that are 1 % of the size of the drawing away at most, so that no triangle collapses and
// both shapes depend on them continuously.
Eigen::Matrix2Xd nearby(const Triangulation& mesh, const std::vector<BarycentricPoint>& points) {
  const double size = (mesh.V.rowwise().maxCoeff() - mesh.V.rowwise().minCoeff()).norm();
  const Eigen::Matrix2Xd rest = at_rest(mesh, points);
  return rest + 0.01 * size * (moved(mesh, points) - rest);
}

// Compares with a solver that has never had another handle. Several edits may come before an
// update. Returns how many compilations did not adapt the one before.
int expect_as_afresh(const Triangulation& mesh, std::ptrdiff_t most) {
  ClosedFormSteps adapting(mesh, ones(mesh));
  RandomHandles handles(mesh, most);
  for (int edit = 1; edit <= kEdits; ++edit) {
    handles.next();
    const std::vector<BarycentricPoint> points = handles.points();
    adapting.compile(points);
    if (edit % 5 == 1) continue;
    const Eigen::Matrix2Xd targets = nearby(mesh, points);
    ClosedFormSteps afresh(mesh, ones(mesh));
    afresh.compile(points);
    adapting.update(targets);
    afresh.update(targets);
    EXPECT_EQ(adapting.intermediate(), afresh.intermediate()) << edit;
    EXPECT_EQ(adapting.positions(), afresh.positions()) << edit;
    EXPECT_EQ(adapting.notes(), afresh.notes()) << edit;
    if (::testing::Test::HasFailure()) break;
  }
  return adapting.compilations();
}

// A ring.
Triangulation ring() {
  Region region{Eigen::Matrix2Xd(2, 24), {Eigen::Matrix2Xd(2, 12)}};
  for (int i = 0; i < 24; ++i) {
    const double angle = 2 * std::numbers::pi * i / 24;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    region.outline.col(i) = 10 * direction;
    if (i % 2 == 0) region.holes[0].col(i / 2) = 4 * direction;
  }
  return triangulate(region, {.vertices = 150}, "ring");
}

// There are often so many handles on the square that their system is factorized.
TEST(HandleChanges2d, GiveTheResultOfAFullCompilationOnASquare) {
  EXPECT_LT(expect_as_afresh(square(), 22), kEdits / 2);
}
TEST(HandleChanges2d, GiveTheResultOfAFullCompilationOnTwoSquares) {
  EXPECT_EQ(expect_as_afresh(two_squares(), 8), 1);
}
TEST(HandleChanges2d, GiveTheResultOfAFullCompilationOnARing) {
  EXPECT_EQ(expect_as_afresh(ring(), 5), 1);
}

TEST(HandleChanges2d, AfterAResetAllHandlesAreCompiled) {
  const Triangulation mesh = square();
  const std::vector<BarycentricPoint> points = handle_cases(mesh)[1].points;
  ClosedFormSteps steps(mesh, ones(mesh));
  steps.compile(points);
  steps.update(moved(mesh, points));
  const Eigen::Matrix2Xd V = steps.positions();
  steps.reset();
  steps.compile(points);
  EXPECT_EQ(steps.compilations(), 2);
  steps.update(moved(mesh, points));
  EXPECT_EQ(steps.positions(), V);
}

// Both systems, for the same handles, of which one keeps those of the last case.
TEST(HandleChanges2d, BothSystemsAgreeInBothSteps) {
  const Triangulation mesh = square();
  RegisteredMesh registered(mesh, painted(mesh, 50));
  const auto bordered = make_schur_complement_system(registered);
  const auto eliminated = make_elimination_system(registered);
  for (auto& [name, points] : handle_cases(mesh)) {
    const Eigen::Matrix2Xd targets = moved(mesh, points);
    Eigen::VectorXcd q(targets.cols());
    q.real() = targets.row(0);
    q.imag() = targets.row(1);
    for (BarycentricPoint& point : points) {
      for (int& v : point.vertices) v = registered.index[v];
    }
    const MeshHandles handles{points, cluster_handles(points), true};
    bordered->compile(handles);
    eliminated->compile(handles);
    const Eigen::VectorXcd v = bordered->step_one(q);
    EXPECT_LT((v - eliminated->step_one(q)).cwiseAbs().maxCoeff(), 1e-9) << name;
    Eigen::VectorXcd z(v.size());
    registered.fit.fit(v, z);
    Eigen::VectorXcd other = z;
    bordered->step_two(q, z);
    eliminated->step_two(q, other);
    EXPECT_LT((z - other).cwiseAbs().maxCoeff(), 1e-9) << name;
  }
}

}  // namespace
}  // namespace deformlab::test
