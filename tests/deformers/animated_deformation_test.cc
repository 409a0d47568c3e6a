#include "deformers/embedded/animated_deformation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "deformers/embedded/presets.h"
#include "deformers/embedded/stream_deformation.h"
#include "geometry/core/error.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

// The tube, bent more and more along its length.
Shape bent(const Shape& rest, double amount) {
  Shape shape = rest;
  for (auto v : shape.V.colwise()) {
    const Eigen::AngleAxisd turn(amount * v.x(), Eigen::Vector3d::UnitZ());
    v = turn * v;
  }
  shape.N = vertex_normals(shape);
  return shape;
}

Shape moved(Shape shape, const Eigen::Isometry3d& motion) {
  shape.V = motion * shape.V;
  if (shape.N.cols() > 0) shape.N = motion.linear() * shape.N;
  return shape;
}

Eigen::Isometry3d some_motion() {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translate(Eigen::Vector3d(3, -2, 1));
  motion.rotate(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()));
  return motion;
}

EmbeddedDeformationOptions options(NodePlacement method = NodePlacement::kSampling) {
  EmbeddedDeformationOptions o;
  o.graph.method = method;
  o.graph.nodes = 40;
  o.solver.epsilon = 1e-12;
  return o;
}

// One end stays, a vertex at the other goes aside.
const Handles kHandles{.fixed = {0, 1, 2, 3, 4, 5}, .moved = {230, 236}};

Eigen::Matrix3Xd offsets() {
  Eigen::Matrix3Xd o(3, 2);
  o << 0, 0, 0.5, 0.5, 1, 1;
  return o;
}

class EveryGraph : public ::testing::TestWithParam<NodePlacement> {};

TEST_P(EveryGraph, NodesSitOnVerticesAndGoWithThem) {
  const Shape rest = tube(20);
  AnimatedDeformation deformer(rest, options(GetParam()));
  deformer.compile(kHandles);
  const auto edges = deformer.deformation().graph().edges;
  for (const double amount : {0.0, 0.05, 0.1}) {
    const Shape frame = bent(rest, amount);
    deformer.update(frame, offsets());
    const DeformationGraph& graph = deformer.deformation().graph();
    EXPECT_EQ(graph.g, frame.V(Eigen::all, deformer.node_vertices()));
    ASSERT_EQ(graph.edges.size(), edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e) EXPECT_EQ(graph.edges[e].k, edges[e].k);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, EveryGraph,
                         ::testing::Values(NodePlacement::kSampling,
                                           NodePlacement::kSimplification));

// How far the output of a moved input, with offsets moved alike, is from the moved output.
double off_after(const Eigen::Isometry3d& motion) {
  const Shape rest = tube(20), frame = bent(rest, 0.06);
  AnimatedDeformation deformer(rest, options()), in_motion(rest, options());
  deformer.compile(kHandles);
  in_motion.compile(kHandles);
  deformer.update(frame, offsets());
  in_motion.update(moved(frame, motion), motion.linear() * offsets());
  return (in_motion.deformed().V - motion * deformer.deformed().V).colwise().norm().maxCoeff();
}

TEST(AnimatedDeformation, ARigidMotionOfInputAndOffsetsIsOneOfTheOutput) {
  Eigen::Isometry3d quarter(Eigen::Translation3d(3, -2, 1));
  EXPECT_LT(off_after(quarter), 1e-6);
  quarter.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  EXPECT_LT(off_after(quarter), 1e-6);
  // Eq. 5 counts each product of two columns once, where the norm of RᵀR − I has it twice. So what
  // is stretched by force depends a little on how it is turned, here by 3 % of the offset.
  EXPECT_LT(off_after(some_motion()), 0.05 * offsets().col(0).norm());
}

// The angle of the rotation that best takes p to q [degree].
double turn_between(const Eigen::Matrix3Xd& p, const Eigen::Matrix3Xd& q) {
  const Eigen::Matrix3d R = Eigen::umeyama(p, q, false).topLeftCorner<3, 3>();
  return Eigen::AngleAxisd(R).angle() * 180 / std::numbers::pi;
}

// Three vertices on top of a tube that bends. Nothing but them holds the roll of the tube.
TEST(AnimatedDeformation, HandlesOnALineDoNotLetTheShapeRoll) {
  const Shape rest = tube(20);
  AnimatedDeformation deformer(rest, preset_options());
  deformer.compile({.fixed = {}, .moved = {3, 111, 231}});
  Eigen::Matrix3Xd offsets = Eigen::Matrix3Xd::Zero(3, 3);
  offsets.col(1) << 0, 0.3, 0.3;
  for (const double amount : {0.0, 0.01, 0.02, 0.03}) {
    const Shape frame = bent(rest, amount);
    const Report report = deformer.update(frame, offsets);
    EXPECT_EQ(report.solve.status, Status::kConverged);
    EXPECT_LT(report.handle_max, 1e-3);
    EXPECT_LT(turn_between(frame.V, deformer.deformed().V), 8) << amount;
  }
}

TEST(AnimatedDeformation, WithoutOffsetsTheOutputIsTheInput) {
  const Shape rest = tube(20);
  AnimatedDeformation deformer(rest, options());
  deformer.compile(kHandles);
  for (const double amount : {0.0, 0.06}) {
    const Shape frame = bent(rest, amount);
    deformer.update(frame, Eigen::Matrix3Xd::Zero(3, 2));
    EXPECT_LT((deformer.deformed().V - frame.V).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(AnimatedDeformation, AFrameDependsOnNoOther) {
  const Shape rest = tube(20), frame = bent(rest, 0.08);
  AnimatedDeformation alone(rest, options()), after_others(rest, options());
  alone.compile(kHandles);
  after_others.compile(kHandles);
  alone.update(frame, offsets());
  after_others.update(bent(rest, 0.2), 2 * offsets());
  after_others.update(frame, offsets());
  EXPECT_EQ(alone.deformed().V, after_others.deformed().V);
}

TEST(AnimatedDeformation, HandlesGoByTheirOffsetsAndFixedVerticesWithTheInput) {
  const Shape rest = tube(20), frame = bent(rest, 0.1);
  AnimatedDeformation deformer(rest, options());
  deformer.compile(kHandles);
  const Report report = deformer.update(frame, offsets());
  EXPECT_EQ(report.solve.status, Status::kConverged);
  EXPECT_LT(report.handle_max, 0.05);
  for (const int i : kHandles.fixed) EXPECT_EQ(deformer.deformed().V.col(i), frame.V.col(i)) << i;
  const Eigen::Vector3d way = deformer.deformed().V.col(230) - frame.V.col(230);
  EXPECT_LT((way - offsets().col(0)).norm(), 0.05);
}

TEST(AnimatedDeformation, RefusesWhatDoesNotFollow) {
  const Shape rest = tube(20);
  AnimatedDeformation deformer(rest, options());
  Handles place;
  place.points = Eigen::Matrix3Xd::Zero(3, 1);
  EXPECT_THROW(deformer.compile(place), InputError);
  deformer.compile(kHandles);
  EXPECT_THROW(deformer.update(tube(21), offsets()), InputError);
  EXPECT_THROW(deformer.update(rest, Eigen::Matrix3Xd::Zero(3, 3)), InputError);
}

// A path along a half turn of a helix.
Eigen::Matrix3Xd path(int m) {
  Eigen::Matrix3Xd samples(3, m);
  for (int j = 0; j < m; ++j) {
    const double t = 3.0 * j / (m - 1);
    samples.col(j) << std::cos(t), std::sin(t), 0.3 * t;
  }
  return samples;
}

TEST(StreamDeformation, JoinsEachSampleToThePreviousAndTheNext) {
  const StreamDeformation stream(path(20), options());
  const auto& edges = stream.deformation().graph().edges;
  ASSERT_EQ(edges.size(), 19u);
  for (int j = 0; j < 19; ++j) {
    EXPECT_EQ(edges[j].j, j);
    EXPECT_EQ(edges[j].k, j + 1);
  }
}

// Nothing in E_reg says how a straight chain turns about itself: JᵀJ is nearly singular, and only
// steps in a metric that knows of rotations leave alone what no handle asks for.
EmbeddedDeformationOptions for_a_chain() {
  EmbeddedDeformationOptions o;
  o.solver.linear_solver = "kronecker_cg";
  return o;
}

// Handles, and where `motion` takes them.
struct Held {
  std::vector<int> nodes;
  Eigen::Matrix3Xd targets;
};

StreamDeformation moved_stream(const Held& held) {
  StreamDeformation stream(path(20), for_a_chain());
  stream.compile({.fixed = {}, .moved = held.nodes});
  EXPECT_NE(stream.update(held.targets).solve.status, Status::kFailed);
  return stream;
}

Held all_moved(const Eigen::Isometry3d& motion) {
  const std::vector<int> nodes{0, 6, 12, 19};
  return {nodes, motion * path(20)(Eigen::all, nodes)};
}

TEST(StreamDeformation, TakesParticlesAlong) {
  const Eigen::Isometry3d motion(Eigen::Translation3d(1, -2, 0.5));
  const StreamDeformation stream = moved_stream(all_moved(motion));
  const Eigen::Matrix3Xd particles = random_points(50, {1, 1, 1}, 3);
  EXPECT_LT((stream.deformed(particles) - motion * particles).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(stream.deformed(Eigen::Matrix3Xd(3, 0)).cols(), 0);
}

TEST(StreamDeformation, TurnsWithItsHandles) {
  const Eigen::Isometry3d motion = some_motion();
  const StreamDeformation stream = moved_stream(all_moved(motion));
  EXPECT_LT((stream.deformed(path(20)) - motion * path(20)).cwiseAbs().maxCoeff(), 0.02);
}

TEST(StreamDeformation, TheInfluenceOnAParticleChangesAsItMoves) {
  const std::vector<int> nodes{0, 10, 19};
  Held held{nodes, path(20)(Eigen::all, nodes)};
  held.targets(2, 2) += 0.3;
  const StreamDeformation stream = moved_stream(held);
  const Eigen::Matrix3Xd way = stream.deformed(path(20)) - path(20);
  EXPECT_LT(way.col(0).norm(), 0.01);
  EXPECT_NEAR(way(2, 19), 0.3, 0.01);
  for (int j = 11; j < 20; ++j) EXPECT_GT(way(2, j), way(2, j - 1)) << j;
}

// A flat arc of 60 nodes that turns through one radian to the left, and `up` of it, its like that
// turns upwards as well.
Eigen::Matrix3Xd arc(bool up) {
  Eigen::Matrix3Xd samples = Eigen::Matrix3Xd::Zero(3, 60);
  for (int j = 1; j < 60; ++j) {
    const double turn = j / 60.0, rise = up ? turn : 0;
    const Eigen::Vector3d along(std::cos(turn) * std::cos(rise), std::sin(turn) * std::cos(rise),
                                std::sin(rise));
    samples.col(j) = samples.col(j - 1) + 0.05 * along;
  }
  return samples;
}

// The greatest change of R from a node to the next.
double roughness(const Transformations& X) {
  double most = 0;
  for (Eigen::Index j = 4; j < X.cols(); j += 4) {
    most = std::max(most, (X.middleCols<3>(j) - X.middleCols<3>(j - 4)).norm());
  }
  return most;
}

TEST(StreamDeformation, SmoothnessKeepsACurvedPathFromTwisting) {
  std::vector<double> rough;
  for (const double weight : {0.0, 1.0}) {
    EmbeddedDeformationOptions o = for_a_chain();
    o.energies["smoothness"] = weight;
    StreamDeformation stream(arc(false), o);
    const std::vector<int> held{0, 15, 30, 45, 59};
    stream.compile({.fixed = {}, .moved = held});
    stream.update(arc(true)(Eigen::all, held));
    rough.push_back(roughness(stream.deformation().transformations()));
  }
  EXPECT_LT(rough[1], 0.1);
  EXPECT_GT(rough[0], 2 * rough[1]);
}

}  // namespace
}  // namespace deformlab::test
