#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "experiments/scenes/gallop.h"
#include "experiments/scenes/jet.h"
#include "experiments/subjects/animation/mesh_measurements.h"
#include "experiments/subjects/particles/stream_measurements.h"
#include "geometry/graph/placement/graph_simplification.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

const char* const kGallop =
    "title: a small gallop\n"
    "animation:\n  generator: gallop\n  frames: 4\n  cycle: 24\n  cell: 0.06\n  pictured: 2\n"
    "measure: {region: {box: {min: [1.2, -1, 1.3], max: [2, 1, 2]}}}\n"
    "graph: {nodes: 60}\n"
    "edit:\n"
    "  - {select: {nearest: [0.5, 0, 1.4]}, by: [0, 0, 0]}\n"
    "  - {select: {nearest: [-0.6, 0, 1.4]}, by: [0, 0, 0]}\n"
    "  - {select: {nearest: [1.6, 0, 1.4]}, by: [0, 0.1, 0.1]}\n"
    "picture: {direction: [0, 1, 0], width: 80, height: 60}\n";

const char* const kJet =
    "title: a short jet\n"
    "animation: {generator: jet, frames: 20, pictured: 1}\n"
    "graph: {nodes: 15}\n"
    "edit:\n"
    "  - {select: {vertices: [0, 7]}, by: [0, 0, 0]}\n"
    "  - {select: {vertices: [14]}, by: [0, 0.1, 0]}\n"
    "picture: {direction: [0, 1, 0], width: 80, height: 60}\n";

class AnimationRun : public Program {
 protected:
  AnimationRun() {
    put("gallop.yaml", kGallop);
    put("jet.yaml", kJet);
  }

  nlohmann::json metrics(const std::string& name) const {
    const auto all = nlohmann::json::parse(get("results/" + name + "/metrics.json"));
    return all.at("runs").at(0).at("metrics");
  }
};

TEST_F(AnimationRun, MeasuresMeshes) {
  expect_success({"run", "gallop.yaml"});
  const auto m = metrics("gallop");
  EXPECT_EQ(m.at("solves"), 4);
  EXPECT_EQ(m.at("handles"), 3);
  EXPECT_EQ(m.at("nodes"), 60);
  for (const char* name :
       {"displacement", "unsteadiness", "region.edge_error_mean", "stretch_mean"}) {
    EXPECT_GT(m.at(name).get<double>(), 0) << name;
  }
  EXPECT_GT(m.at("region.fast_motion_kept").get<double>(), 0.8);
}

TEST_F(AnimationRun, MeasuresParticles) {
  expect_success({"run", "jet.yaml"});
  const auto m = metrics("jet");
  EXPECT_NEAR(m.at("particles").get<double>(), 1070, 1);
  EXPECT_EQ(m.at("born"), 10);
  EXPECT_EQ(m.at("died"), 10);
  EXPECT_EQ(m.at("edges"), 14);
  EXPECT_EQ(m.at("solves"), 1);
  EXPECT_GT(m.at("speed_correlation").get<double>(), 0.5);
}

TEST_F(AnimationRun, TheSameBytesTwice) {
  expect_success({"run", "gallop.yaml", "jet.yaml"});
  const auto first = contents();
  expect_success({"run", "gallop.yaml", "jet.yaml"});
  EXPECT_THAT(changes_since(first), ::testing::Each(::testing::HasSubstr("times.json")));
}

// Width and height of a PNG, from its first chunk.
std::string size_of(const std::string& png) { return png.substr(16, 8); }

TEST_F(AnimationRun, WritesAnImageSequence) {
  expect_success({"run", "gallop.yaml", "animation.sequence={every: 3, width: 40}"});
  const std::string frames = "results/gallop/frames/", first = get(frames + "0000.png");
  EXPECT_EQ(first.substr(1, 3), "PNG");
  EXPECT_EQ(size_of(get(frames + "0001.png")), size_of(first));
  EXPECT_FALSE(get(frames + "0001.png") == first);
  EXPECT_FALSE(exists(frames + "0002.png"));
  EXPECT_THAT(get("results/README.md"), ::testing::HasSubstr("[0001](gallop/frames/0001.png)"));
  const auto before = contents();
  expect_success({"run", "gallop.yaml", "animation.sequence={every: 3, width: 40}"});
  EXPECT_THAT(changes_since(before), ::testing::Each(::testing::HasSubstr("times.json")));
  expect_success({"run", "gallop.yaml"});
  EXPECT_FALSE(exists(frames));
  EXPECT_EQ(get("results/README.md").find("frames/0"), std::string::npos);
}

TEST_F(AnimationRun, ASequenceShowsEachRunOfASweep) {
  const Words words{"run", "jet.yaml", "animation.sequence={every: 19, width: 40}"};
  expect_success(words);
  const std::string one = size_of(get("results/jet/frames/0001.png"));
  expect_success({words[0], words[1], words[2], "sweep={graph.nodes: [15, 20, 25]}"});
  const std::string three = size_of(get("results/jet/frames/0001.png"));
  EXPECT_EQ(three.substr(4), one.substr(4));        // as high,
  EXPECT_GT(three.substr(0, 4), one.substr(0, 4));  // but wider: big endian, which compares as text
}

TEST_F(AnimationRun, ASweepMayLookFromElsewhere) {
  const std::string from_above = "picture.direction: [0, 0, -1], picture.up: [1, 0, 0]";
  expect_success({"run", "gallop.yaml"});
  const std::string one = get("results/gallop/picture.png");
  expect_success({"run", "gallop.yaml",
                  "sweep={seen: {here: {graph.nodes: 60}, there: {" + from_above + "}}}"});
  EXPECT_FALSE(get("results/gallop/picture.png") == one);
  expect_refused({"run", "gallop.yaml", "sweep={picture.width: [30, 40]}"}, {"changes no run"});
  expect_refused({"run", "gallop.yaml", "sweep={picture.up: [[0, 0, 0]]}"},
                 {"camera", "parallel to its up"});
}

TEST_F(AnimationRun, SweepsShowEachRun) {
  expect_success({"run", "gallop.yaml", "sweep={graph.nodes: [50, 60]}"});
  EXPECT_TRUE(exists("results/gallop/trace_002.csv"));
}

TEST_F(AnimationRun, RefusesWhatCannotBe) {
  const std::pair<std::string, Words> bad[] = {
      {"animation.frames=0", {"animation.frames is 0", "1 to"}},
      {"animation.pictured=5", {"animation.pictured is 5", "1 to 4"}},
      {"animation.sequence.every=-1", {"sequence.every is -1", "at least 0"}},
      {"animation={generator: gallop, frames: 9999, sequence: {every: 1}}",
       {"sequence.every is 1", "at least 42 for 9999 frames"}},
      {"animation.sequence.width=4", {"sequence.width is 4", "16 to 1024"}},
      {"animation.sequence=2", {"animation.sequence", "map"}},
      {"animation.bend=-1", {"animation.bend is -1", "0 to 180"}},
      {"animation.bend=181", {"animation.bend is 181", "0 to 180"}},
      {"animation.cycle=0", {"animation.cycle"}},
      {"animation.cell=1", {"animation.cell", "0.01 to 0.06"}},
      {"animation.generator=trot", {"'trot'", "gallop, jet"}},
      {"measure.region={}", {"measure.region", "exactly one of"}},
      {"measure.region={point: [0, 0, 0]}", {"measure.region", "take 'nearest'"}},
      {"animation.pose=9", {"'pose'", "0 to 3"}},
      {"animation.keyframes=[{frame: 9, edit: [{select: {all: true}, fix: true}]}]",
       {"names frame 9"}},
      {"deformer=rbf", {"deformer is rbf", "takes no animation"}},
      {"edit=[{select: {point: [0, 0, 0]}, by: [0, 0, 1]}]", {"does not follow"}}};
  for (const auto& [change, words] : bad) {
    SCOPED_TRACE(change);
    expect_refused({"run", "gallop.yaml", change}, words);
  }
  expect_refused({"run", "jet.yaml", "animation.path=-5"}, {"particle -5", "the jet"});
  expect_refused({"run", "jet.yaml", "animation.pose=0"}, {"'pose' is for meshes"});
}

TEST(Gallop, IsAClosedMeshOfAnySize) {
  for (const double cell : {0.06, 0.05, 0.04}) {
    const Shape shape = Gallop(cell).pose(0.3);
    EXPECT_EQ(simplify(shape, 100, 5).vertices.size(), 100u) << cell;  // throws where it is not
  }
}

TEST(Gallop, ComesBackAfterACycle) {
  const Gallop gallop(0.06);
  EXPECT_LT((gallop.pose(0.2).V - gallop.pose(1.2).V).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT((gallop.pose(0.2).V - gallop.pose(0.7).V).cwiseAbs().maxCoeff(), 0.2);
}

TEST(FindPath, TakesTheParticleThatGoesStraightest) {
  const Jet jet(120);
  const ParticleLife life = find_path(jet, {});
  EXPECT_EQ(life.last - life.first, 106);
  EXPECT_EQ(life.id % 10, 0);
  const Eigen::Matrix3Xd samples = sample_path(jet, life, 54);
  EXPECT_EQ(samples.col(0), life.begin);
  EXPECT_EQ(samples.col(53), life.end);
  const ParticleLife swirling = find_path(jet, life.id + 1);
  EXPECT_GT(swirling.travelled, life.travelled);
}

TEST(Jet, TurnsUpwardsByItsBend) {
  const Eigen::Matrix3Xd straight = sample_path(Jet(120), find_path(Jet(120), {}), 300);
  const Jet bent(120, 90);
  const Eigen::Matrix3Xd path = sample_path(bent, find_path(bent, {}), 300);
  const double length = straight(0, 299) - straight(0, 0);
  double travelled = 0;
  for (int j = 1; j < 300; ++j) travelled += (path.col(j) - path.col(j - 1)).norm();
  EXPECT_NEAR(travelled, length, 1e-3 * length);
  EXPECT_LT(path.row(1).cwiseAbs().maxCoeff(), 1e-12);
  const Eigen::Vector3d last = (path.col(299) - path.col(298)).normalized();
  EXPECT_LT((last - Eigen::Vector3d::UnitZ()).norm(), 0.05);
}

// A straight chain along x, whose ends are turned about it against each other by turning two places
// beside each.
StreamDeformation turned_chain(double degrees) {
  Eigen::Matrix3Xd samples = Eigen::Matrix3Xd::Zero(3, 11);
  samples.row(0).setLinSpaced(11, 0, 10);
  EmbeddedDeformationOptions o;
  o.solver.linear_solver = "kronecker_cg";
  o.energies["smoothness"] = 1;
  StreamDeformation stream(samples, o);
  Eigen::Matrix3Xd points(3, 6);
  points << 0, 0, 0, 10, 10, 10, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1;
  const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitX());
  Eigen::Matrix3Xd targets = points;
  targets.rightCols(3) = turn * points.rightCols(3);
  Handles handles;
  handles.points = points;
  stream.compile(handles);
  EXPECT_EQ(stream.update(targets).solve.status, Status::kConverged);
  return stream;
}

TEST(TwistOf, IsTheAngleBetweenTheEnds) {
  EXPECT_NEAR(twist_of(turned_chain(0)).at("twist"), 0, 1e-6);
  for (const double degrees : {60.0, -60.0}) {
    const StreamDeformation stream = turned_chain(degrees);
    const Transformations X = stream.deformation().transformations();
    // The places hang on more nodes than the last, so that these turn by more than 60 degrees.
    const double between = turn_between(X.leftCols<3>(), X.middleCols<3>(40));
    EXPECT_NEAR(between, 60, 10);
    const Metrics m = twist_of(stream);
    EXPECT_NEAR(m.at("twist"), between, 1);
    EXPECT_GE(m.at("twist_max"), m.at("twist") / 10);
    EXPECT_LT(m.at("twist_max"), 30);
  }
}

// n points that go to and fro, at a time.
Eigen::Matrix3Xd waving(int n, double time) {
  Eigen::Matrix3Xd V = random_points(n, {1, 1, 1}, 5);
  V.row(0).array() += std::sin(time);
  return V;
}

TEST(Coherence, OfAnOffsetThatStaysIsPerfect) {
  Coherence c;
  for (int t = 0; t < 9; ++t) {
    const Eigen::Matrix3Xd V = waving(10, t);
    c.add(V, V.colwise() + Eigen::Vector3d(0, 0.3, 0.4));
  }
  const Metrics m = c.metrics();
  EXPECT_NEAR(m.at("displacement"), 0.5, 1e-12);
  EXPECT_NEAR(m.at("displacement_change_max"), 0, 1e-12);
  EXPECT_NEAR(m.at("unsteadiness_max"), 0, 1e-12);
  EXPECT_NEAR(m.at("motion_kept"), 1, 1e-12);
  EXPECT_NEAR(m.at("fast_motion_correlation"), 1, 1e-12);
}

TEST(Coherence, SeesTheFrameThatJumps) {
  Coherence all, some({0, 1});
  for (int t = 0; t < 20; ++t) {
    const Eigen::Matrix3Xd V = waving(10, 0.3 * t);
    Eigen::Matrix3Xd W = V;
    if (t == 10) W.rightCols(8).array() += 0.5;
    all.add(V, W);
    some.add(V, W);
  }
  EXPECT_GT(all.metrics().at("unsteadiness_max"), 5);
  EXPECT_NEAR(some.metrics("a.").at("a.unsteadiness_max"), 0, 1e-12);
}

TEST(Coherence, ComparesNothingAcrossAGap) {
  Coherence c;
  for (int t = 0; t < 9; ++t) {
    if (t == 4) c.interrupt();
    const Eigen::Matrix3Xd V = waving(10, t);
    c.add(V, V.colwise() + Eigen::Vector3d(0, 0, t < 4 ? 0 : 1));
  }
  EXPECT_NEAR(c.metrics().at("displacement_change_max"), 0, 1e-12);
  EXPECT_NEAR(c.metrics().at("displacement"), std::sqrt(5.0 / 9), 1e-12);
}

TEST(TurnBetween, IsTheAngleOfTheRotation) {
  const Eigen::Matrix3Xd V = random_points(20, {1, 2, 3}, 7);
  const Eigen::AngleAxisd turn(0.5, Eigen::Vector3d(1, 2, 2) / 3);
  const Eigen::Matrix3Xd W = (turn.matrix() * V).colwise() + Eigen::Vector3d(4, 5, 6);
  EXPECT_NEAR(turn_between(V, W), 0.5 * 180 / std::numbers::pi, 1e-9);
}

}  // namespace
}  // namespace deformlab::test
