#include "deformers/embedded/adaptive_deformation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

// A strip that is held over the left part of its length and lifted at its right end.
struct Scene {
  Shape shape;
  Handles handles;
  Eigen::Matrix3Xd targets;
  double bends_from = 0.65;

  explicit Scene(int n = 41, double held = 0.7) : shape(bumpy_plane(n, 1, 0)) {
    shape.V.row(1) *= 0.3;
    for (int i = 0; i < shape.V.cols(); ++i) {
      if (shape.V(0, i) < held || shape.V(0, i) > 0.96) handles.moved.push_back(i);
    }
    targets = shape.V(Eigen::all, handles.moved);
    for (auto q : targets.colwise()) {
      if (q.x() > 0.9) q += Eigen::Vector3d(-0.05, 0, 0.12);
    }
  }
};

// The options of a graph at the end, and how it grows to that.
struct Options : EmbeddedDeformationOptions {
  AdaptiveOptions adaptive;
};

Options options(int start = 30, int nodes = 80, int rounds = 3) {
  Options o;
  o.graph.nodes = nodes;
  o.graph.alpha = EdgeWeights::kLength;
  o.adaptive = {start, rounds};
  return o;
}

AdaptiveDeformation deformed(const Scene& scene, const Options& o) {
  AdaptiveDeformation deformer(scene.shape, o, o.adaptive);
  deformer.compile(scene.handles);
  deformer.update(scene.targets);
  return deformer;
}

EmbeddedDeformation coarse(const Scene& scene, int nodes = 30) {
  EmbeddedDeformationOptions o = options(0, nodes);
  EmbeddedDeformation deformer(scene.shape, o);
  deformer.compile(scene.handles);
  deformer.update(scene.targets);
  return deformer;
}

TEST(AdaptiveDeformation, AddsNodesWhereTheShapeBends) {
  const Scene scene;
  const AdaptiveDeformation adaptive = deformed(scene, options());
  const Eigen::Matrix3Xd& g = adaptive.embedded().graph().g;
  ASSERT_EQ(g.cols(), 80);
  EXPECT_EQ(g.leftCols(30), coarse(scene).graph().g);  // those of the start stay
  int near = 0;
  for (const auto added : g.rightCols(50).colwise()) near += added.x() > scene.bends_from;
  EXPECT_GE(near, 40);
  int uniform = 0;
  const EmbeddedDeformation other = coarse(scene, 80);
  for (const auto node : other.graph().g.colwise()) uniform += node.x() > scene.bends_from;
  EXPECT_LE(uniform, 32);
}

TEST(AdaptiveDeformation, ComesNearerToAFineGraphThanAUniformOneOfTwiceAsManyNodes) {
  const Scene scene(81, 0.8);
  const Eigen::Matrix3Xd fine = coarse(scene, 3000).deformed().V;
  const double adaptive = (deformed(scene, options(60, 240, 4)).deformed().V - fine).norm();
  const double uniform = (coarse(scene, 480).deformed().V - fine).norm();
  EXPECT_LT(adaptive, uniform);
}

TEST(AdaptiveDeformation, AFinerGraphBeginsWhereTheCoarseOneEnded) {
  const Scene scene;
  for (const RotationModel model : {RotationModel::kAffine, RotationModel::kRigid}) {
    EmbeddedDeformationOptions o = options(0, 30);
    o.rotation_model = model;
    EmbeddedDeformation before(scene.shape, o);
    before.compile(scene.handles);
    before.update(scene.targets);
    const std::vector<int> added =
        worst_vertices(before.embedding(), before.graph().g, node_costs(before.problem()), 15);
    ASSERT_EQ(added.size(), 15u);
    Eigen::Matrix3Xd g(3, 45);
    g << before.graph().g, scene.shape.V(Eigen::all, added);
    EmbeddedDeformation after(scene.shape, g, o);
    after.compile(scene.handles);
    after.begin_at(continued(before, added));
    const double moved = (before.deformed().V - scene.shape.V).colwise().norm().maxCoeff();
    const auto gap = (after.deformed().V - before.deformed().V).colwise().norm();
    EXPECT_LT(gap.maxCoeff(), 0.2 * moved) << model;
    EXPECT_LT(gap.mean(), 0.01 * moved) << model;
    const Report report = after.update(scene.targets);
    after.reset();
    const Report from_rest = after.update(scene.targets);
    EXPECT_LT(report.solve.initial_cost, 0.1 * from_rest.solve.initial_cost) << model;
    EXPECT_NEAR(report.solve.final_cost, from_rest.solve.final_cost,
                1e-3 * from_rest.solve.final_cost)
        << model;
  }
}

TEST(AdaptiveDeformation, CostsOfNodesAddUpToF) {
  const EmbeddedDeformation deformer = coarse(Scene());
  const Eigen::VectorXd costs = node_costs(deformer.problem());
  EXPECT_GT(costs.minCoeff(), 0);
  const double F = cost(deformer.problem(), deformer.problem().x);
  EXPECT_NEAR(costs.sum(), F, 1e-12 * F);
}

TEST(AdaptiveDeformation, TakesTheCostliestPlacesFarFromNodesFirst) {
  Embedding vertices;
  vertices.v = Eigen::Matrix3Xd::Zero(3, 5);
  vertices.v.row(0) << 0, 1, 2, 9, 10;
  vertices.nodes = Eigen::MatrixXi(1, 5);
  vertices.nodes << 0, 0, 0, 1, 1;
  vertices.weights = Eigen::MatrixXd::Ones(1, 5);
  Eigen::Matrix3Xd g(3, 2);
  g << 0, 10, 0, 0, 0, 0;
  const auto worst = [&](double a, double b, int count) {
    return worst_vertices(vertices, g, Eigen::Vector2d(a, b), count);
  };
  EXPECT_THAT(worst(1, 1, 2), ::testing::ElementsAre(2, 1));
  EXPECT_THAT(worst(1, 3, 2), ::testing::ElementsAre(3, 2));
  EXPECT_THAT(worst(0, 1, 9), ::testing::ElementsAre(3));
  EXPECT_THAT(worst(1, 1, 9), ::testing::ElementsAre(2, 1, 3));  // each vertex once
  EXPECT_THAT(worst(0, 0, 9), ::testing::IsEmpty());
}

// A costly node may be fixed because of a fixed vertex far away that hardly follows it. It is free
// once that vertex has nearer nodes.
TEST(AdaptiveDeformation, ACostlyNodeCountsInFullForAllThatFollowIt) {
  Embedding vertices;
  vertices.v = Eigen::Matrix3Xd::Zero(3, 3);
  vertices.v.row(0) << 3, 9, 10;
  vertices.nodes = Eigen::MatrixXi(2, 3);
  vertices.nodes << 0, 1, 1, 1, 0, 0;
  vertices.weights = Eigen::MatrixXd(2, 3);
  vertices.weights << 0.99, 0.99, 1, 0.01, 0.01, 0;
  Eigen::Matrix3Xd g(3, 2);
  g << 0, 10, 0, 0, 0, 0;
  EXPECT_THAT(worst_vertices(vertices, g, Eigen::Vector2d(0, 1), 1), ::testing::ElementsAre(0));
}

TEST(AdaptiveDeformation, AddsNothingAtRestAndNothingMoreOnceItIsThere) {
  const Scene scene;
  AdaptiveDeformation deformer(scene.shape, options(), options().adaptive);
  deformer.compile(scene.handles);
  const Report rest = deformer.update(scene.shape.V(Eigen::all, scene.handles.moved));
  EXPECT_EQ(rest.nodes, 30);
  EXPECT_EQ(deformer.update(scene.targets).nodes, 80);
  const Eigen::Matrix3Xd g = deformer.embedded().graph().g;
  EXPECT_EQ(deformer.update(scene.targets).nodes, 80);
  deformer.reset();
  EXPECT_EQ(deformer.deformed().V, scene.shape.V);
  deformer.compile(scene.handles);
  deformer.update(scene.targets);
  EXPECT_EQ(deformer.embedded().graph().g, g);
}

TEST(AdaptiveDeformation, GivesTheSameTwiceAndOnTwoThreads) {
  const Scene scene;
  Options threaded = options();
  threaded.solver.threads = threaded.transfer_threads = 2;
  const AdaptiveDeformation one = deformed(scene, options()), other = deformed(scene, threaded);
  EXPECT_EQ(one.deformed().V, deformed(scene, options()).deformed().V);
  EXPECT_EQ(one.deformed().V, other.deformed().V);
}

TEST(AdaptiveDeformation, ReportsTheStepsOfAllSolves) {
  const Scene scene;
  AdaptiveDeformation deformer(scene.shape, options(), options().adaptive);
  deformer.compile(scene.handles);
  const Report report = deformer.update(scene.targets);
  EXPECT_EQ(report.solve.unknowns, 12 * 80);
  EmbeddedDeformation first(scene.shape, options(0, 30));
  first.compile(scene.handles);
  const Report start = first.update(scene.targets);
  EXPECT_DOUBLE_EQ(report.solve.initial_cost, start.solve.initial_cost);
  EXPECT_GT(report.solve.iterations.size(), start.solve.iterations.size() + 2);
}

TEST(AdaptiveDeformation, TakesWhatEmbeddedDeformationTakes) {
  Scene scene;
  Options rigid = options(), along = options(), few = options(1, 2, 1);
  rigid.rotation_model = RotationModel::kRigid;
  along.graph.distance = NodeDistance::kGeodesic;
  for (const Options& o : {rigid, along, few}) {
    EXPECT_EQ(deformed(scene, o).embedded().graph().g.cols(), o.graph.nodes);
  }
  Options flat = options();
  flat.dimension = 2;
  scene.targets.row(1) += scene.targets.row(2);
  scene.targets.row(2).setZero();
  EXPECT_EQ(deformed(scene, flat).deformed().V.row(2).norm(), 0);
  scene.shape.faces.clear();
  EXPECT_EQ(deformed(scene, options()).embedded().graph().g.cols(), 80);
}

TEST(AdaptiveDeformation, HasANodeAVertexAtMost) {
  Scene scene;
  scene.shape = tube(4);
  scene.handles.moved = {0, 1, 2, 45, 46};
  scene.targets = 1.3 * scene.shape.V(Eigen::all, scene.handles.moved);
  AdaptiveDeformation deformer = deformed(scene, options(10, 300, 3));
  EXPECT_LE(deformer.embedded().graph().g.cols(), 10 + scene.shape.V.cols());
  const Report report = deformer.update(scene.targets);
  EXPECT_THAT(report.notes, ::testing::Contains(::testing::HasSubstr("instead of graph.nodes")));
  EXPECT_TRUE(deformer.deformed().V.allFinite());
}

void expect_refused(const Options& o, const std::string& said) {
  EXPECT_THAT(error_of([&] { const AdaptiveDeformation deformer(Scene().shape, o, o.adaptive); }),
              ::testing::HasSubstr(said));
}

TEST(AdaptiveDeformation, RefusesWhatCannotBe) {
  expect_refused(options(-1), "adaptive.start is -1; allowed: at least 0");
  expect_refused(
      options(80),
      "adaptive.start is 80; allowed: at least 1 and less than graph.nodes, which is 80");
  expect_refused(options(30, 80, 0), "adaptive.rounds is 0; allowed: at least 1");
  expect_refused(options(30, 80, 51), "adaptive.rounds is 51; allowed: 1 to 50");
  Options by_hand = options();
  by_hand.graph.method = NodePlacement::kFile;
  by_hand.graph.file = "graph.obj";
  expect_refused(by_hand, "graph.method is file");
  expect_refused(options(0), "adaptive.start is 0");
}

TEST(AdaptiveDeformation, BeginsOnlyWithAsManyTransformations) {
  EmbeddedDeformation deformer = coarse(Scene());
  EXPECT_THROW(deformer.begin_at(rest_transformations(29)), InputError);
}

}  // namespace
}  // namespace deformlab::test
