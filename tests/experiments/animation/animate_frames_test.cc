#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "geometry/shape/shape_io.h"
#include "tests/support/animations.h"
#include "tests/support/program.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string name(const std::string& prefix, int frame) {
  return prefix + (frame < 10 ? "00" : frame < 100 ? "0" : "") + std::to_string(frame) + ".obj";
}

class AnimateFrames : public Program {
 protected:
  AnimateFrames() {
    put("edit.yaml", kTubeEdit);
    put_frames(5, 9);
  }

  void put_frames(int first, int last) const {
    for (int frame = first; frame <= last; ++frame) put(name("in-", frame), tube_frame(frame));
  }

  static Words words(const Words& more = {}) {
    Words all{"animate", "--frames",     "in-%03d.obj", "--edit", "edit.yaml",
              "--out",   "out-%03d.obj", "--nodes",     "20"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  Eigen::Matrix3Xd way(int frame) const {
    return read_shape(place(name("out-", frame))).V - read_shape(place(name("in-", frame))).V;
  }
};

TEST_F(AnimateFrames, EditsEveryFrame) {
  const Ending ending = expect_success(words());
  EXPECT_THAT(ending.out, HasSubstr("5 frames, 5 of them made now"));
  EXPECT_THAT(ending.err, HasSubstr("frame 5 of 5"));
  for (int frame = 5; frame <= 9; ++frame) {
    const Eigen::Matrix3Xd moved = way(frame);
    EXPECT_TRUE(moved.leftCols(12).isZero(0)) << frame;
    EXPECT_LT((moved.col(108) - Eigen::Vector3d(0, 0, 0.5)).norm(), 0.05) << frame;
    const std::string in = get(name("in-", frame)), out = get(name("out-", frame));
    EXPECT_EQ(out.substr(out.find("f ")), in.substr(in.find("f ")));
    EXPECT_THAT(out, HasSubstr("# frame " + std::to_string(frame) + "\n"));
  }
  EXPECT_FALSE(exists("out-004.obj") || exists("out-010.obj") || exists("out-%03d.obj.progress"));
}

TEST_F(AnimateFrames, DrawsAContactSheet) {
  expect_success(words());
  const std::string out = get("out-007.obj");
  const Words drawn{"--picture", "p.png", "pictured=2", "picture.width=80", "picture.height=60"};
  expect_success(words(drawn));
  const std::string picture = get("p.png");
  EXPECT_EQ(picture.substr(1, 3), "PNG");
  EXPECT_TRUE(get("out-007.obj") == out);
  expect_success(words(drawn));
  EXPECT_TRUE(get("p.png") == picture);
  put("edit.yaml", "edit:\n  - {select: {all: true}, by: [0, 0, 0]}\n");
  expect_success(words(drawn));
  EXPECT_FALSE(get("p.png") == picture);
}

TEST_F(AnimateFrames, MeasuresFrameByFrame) {
  expect_success(words({"--metrics", "m.json"}));
  const auto m = nlohmann::json::parse(get("m.json"));
  EXPECT_EQ(m.at("solver"), "gauss_newton");
  EXPECT_EQ(m.at("frames"), 5);
  EXPECT_EQ(m.at("solves"), 5);
  EXPECT_EQ(m.at("nodes"), 20);
  EXPECT_EQ(m.at("converged"), 1);
  double sum = 0;
  for (int frame = 5; frame <= 9; ++frame) sum += way(frame).squaredNorm();
  EXPECT_NEAR(m.at("displacement").get<double>(), std::sqrt(sum / (5 * 120)), 1e-6);
  EXPECT_GT(m.at("stretch_mean").get<double>(), 0);
  EXPECT_LT(m.at("unsteadiness").get<double>(), 1);
  EXPECT_TRUE(m.at("notes").empty());
  EXPECT_GT(m.at("seconds").at("seconds.solve").get<double>(), 0);
}

TEST_F(AnimateFrames, OfOneFrameMeasuresNoChange) {
  put("edit.yaml", kTubeEdit);
  put("one-1.obj", tube_frame(3));
  expect_success(words({"--frames", "one-%d.obj", "--metrics", "m.json", "--picture", "p.png",
                        "picture.width=80", "picture.height=60"}));
  const auto m = nlohmann::json::parse(get("m.json"));
  EXPECT_GT(m.at("displacement").get<double>(), 0);
  EXPECT_FALSE(m.contains("unsteadiness") || m.contains("motion_kept"));
}

TEST_F(AnimateFrames, WritesAnotherFormatAndElsewhere) {
  std::filesystem::create_directory(place("made"));
  expect_success(words({"--out", "made/%d.ply"}));
  EXPECT_EQ(read_shape(place("made/9.ply")).V.cols(), 120);
}

TEST_F(AnimateFrames, TakesAGraphBySimplification) {
  expect_success(words({"graph.method=simplification", "graph.aspect_ratio=6"}));
  EXPECT_GT(way(7)(2, 108), 0.4);
}

TEST_F(AnimateFrames, WithoutAnOffsetTheOutputIsTheInput) {
  put("edit.yaml",
      "edit:\n  - {select: {vertices: [0, 108]}, by: [0, 0, 0]}\n"
      "keyframes:\n  - {frame: 6, edit: [{select: {vertices: [60]}, by: [0, 0, 0]}]}\n");
  expect_success(words());
  for (int frame = 5; frame <= 9; ++frame) EXPECT_LT(way(frame).cwiseAbs().maxCoeff(), 1e-12);
}

// (x, y, z) → (z + 1, x − 2, y + 3): a rotation about (1, 1, 1) and a translation.
Eigen::Matrix3Xd turned(const Eigen::Matrix3Xd& V) {
  const Eigen::Matrix3Xd rotated = V({2, 0, 1}, Eigen::all);
  return rotated.colwise() + Eigen::Vector3d(1, -2, 3);
}

// Sampling and simplification could choose other vertices of a turned shape.
std::string graph_on_vertices(const Eigen::Matrix3Xd& V) {
  std::ostringstream nodes, edges;
  nodes.precision(17);
  const int m = static_cast<int>(V.cols()) / 5;
  for (int j = 0; j < m; ++j) {
    nodes << "v " << V.col(5 * j).transpose() << '\n';
    for (int k = j + 1; k < std::min(j + 4, m); ++k) edges << "l " << j + 1 << ' ' << k + 1 << '\n';
  }
  return nodes.str() + edges.str();
}

TEST_F(AnimateFrames, ARigidMotionOfTheInputIsOneOfTheOutput) {
  for (int frame = 5; frame <= 9; ++frame) {
    Shape shape = read_shape(place(name("in-", frame)));
    if (frame == 5) put("graph.obj", graph_on_vertices(shape.V));
    shape.V = turned(shape.V);
    if (frame == 5) put("turned.obj", graph_on_vertices(shape.V));
    write_shape(place(name("turned-", frame)), shape);
  }
  const Words precise{"graph.method=file", "solver.epsilon=1e-12", "graph.file=graph.obj"};
  expect_success(words(precise));
  put("edit.yaml",
      "edit:\n"
      "  - {select: {box: {min: [-1, -3, 1], max: [3, -1.9, 5]}}, fix: true}\n"
      "  - {select: {vertices: [108, 111, 114, 117]}, by: [0.5, 0, 0]}\n");
  expect_success(words({"--frames", "turned-%03d.obj", "--out", "moved-%03d.obj", precise[0],
                        precise[1], "graph.file=turned.obj"}));
  for (int frame = 5; frame <= 9; ++frame) {
    const Eigen::Matrix3Xd expected = turned(read_shape(place(name("out-", frame))).V);
    const Eigen::Matrix3Xd moved = read_shape(place(name("moved-", frame))).V;
    EXPECT_LT((moved - expected).cwiseAbs().maxCoeff(), 1e-5) << frame;
    EXPECT_GT(way(frame)(2, 108), 0.4);
  }
}

TEST_F(AnimateFrames, KeyframesOnOnePoseAreInterpolated) {
  put("edit.yaml",
      "pose: 5\n"
      "edit:\n  - {select: {nearest: [0, 1, 0]}, fix: true}\n"
      "keyframes:\n"
      "  - frame: 8\n    edit: [{select: {vertices: [108, 111, 114, 117]}, by: [0, 0, 0.3]}]\n"
      "  - frame: 6\n    edit: [{select: {vertices: [108, 111, 114, 117]}, by: [0, 0, 0]}]\n");
  expect_success(words());
  EXPECT_LT(way(5).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(way(6).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_NEAR(way(7)(2, 108), 0.15, 0.02);
  EXPECT_NEAR(way(8)(2, 108), 0.3, 0.02);
  EXPECT_NEAR(way(9)(2, 108), 0.3, 0.02);
}

TEST_F(AnimateFrames, AKeyframeSpeaksOfItsOwnPose) {
  const Eigen::Vector3d p = read_shape(place("in-009.obj")).V.col(108);
  put("edit.yaml",
      "edit:\n  - {select: {vertices: [0, 3, 6]}, by: [0, 0, 0]}\n"
      "keyframes:\n  - {frame: 9, edit: [{select: {vertices: [108]}, to: [" +
          std::to_string(p.x()) + ", " + std::to_string(p.y()) + ", " + std::to_string(p.z() + 1) +
          "]}]}\n");
  expect_success(words());
  for (int frame = 5; frame <= 9; ++frame) EXPECT_NEAR(way(frame)(2, 108), 1, 0.05) << frame;
}

TEST_F(AnimateFrames, TellsWhatItRulesOnce) {
  put("edit.yaml", "edit:\n  - {select: {vertices: [108]}, by: [0, 0, 0.5]}\n");
  const Ending ending = expect_success(words());
  const std::size_t first = ending.err.find("at one point only");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(ending.err.find("at one point only", first + 1), std::string::npos) << ending.err;
}

TEST_F(AnimateFrames, StopsAtTheFrameWhereTheSolverFails) {
  const Ending ending = start(words({"energies.rotation=1e308"}));
  EXPECT_EQ(ending.status, 1);
  EXPECT_THAT(ending.err, AllOf(HasSubstr("frame 5"), HasSubstr("the solver failed")));
  EXPECT_FALSE(exists("out-005.obj"));
}

/// A run over many frames that is killed on the way, and what the same run gives that is not.
class AnimateResumed : public AnimateFrames {
 protected:
  static constexpr int kFrames = 150;

  AnimateResumed() {
    put_frames(0, kFrames - 1);
    expect_success(words({"--out", "whole-%03d.obj"}));
  }

  // Kills the program as soon as it has made a frame. On a busy machine it may be done before.
  void start_and_kill(const std::string& frame) const {
    for (int attempt = 0; attempt < 5; ++attempt) {
      forget();
      const pid_t child = begin();
      while (!exists(frame) && waitpid(child, nullptr, WNOHANG) == 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
      if (exists(frame) && !exists(name("out-", kFrames - 1))) break;
    }
    ASSERT_TRUE(exists("out-%03d.obj.progress"));
    ASSERT_FALSE(exists(name("out-", kFrames - 1)));
  }

  void forget() const {
    for (int frame = 0; frame < kFrames; ++frame) {
      std::filesystem::remove(place(name("out-", frame)));
    }
  }

  pid_t begin() const { return begin_program(place(""), words()); }

  void expect_as_in_one_run() const {
    for (int frame = 0; frame < kFrames; ++frame) {
      EXPECT_TRUE(get(name("out-", frame)) == get(name("whole-", frame))) << frame;
    }
    EXPECT_FALSE(exists("out-%03d.obj.progress"));
  }
};

TEST_F(AnimateResumed, GoesOnToTheSameBytes) {
  start_and_kill("out-004.obj");
  for (int frame = 0; exists(name("out-", frame)); ++frame) {  // none is half written
    EXPECT_TRUE(get(name("out-", frame)) == get(name("whole-", frame))) << frame;
  }
  const Ending ending = expect_success(words());
  EXPECT_THAT(ending.out, Not(HasSubstr("150 of them made now")));
  EXPECT_THAT(ending.err, Not(HasSubstr("starting over")));
  expect_as_in_one_run();
  EXPECT_EQ(contents().size(), 2u * kFrames + kFrames + 1);  // nothing is left behind
}

TEST_F(AnimateResumed, DrawsAllFramesAndTellsWhichItMeasured) {
  const Words small{"--picture", "p.png", "picture.width=40", "picture.height=30"};
  expect_success(words(small));
  const std::string picture = get("p.png");
  start_and_kill("out-004.obj");
  Words more = small;
  more.insert(more.end(), {"--metrics", "m.json"});
  const Ending ending = expect_success(words(more));
  EXPECT_THAT(ending.err, Not(HasSubstr("starting over")));
  EXPECT_TRUE(get("p.png") == picture);
  const auto m = nlohmann::json::parse(get("m.json"));
  const int made = m.at("solves");
  EXPECT_EQ(m.at("frames"), kFrames);
  EXPECT_LT(made, kFrames);
  EXPECT_THAT(m.at("notes").at(0).get<std::string>(),
              AllOf(HasSubstr("of 150 frames were made by an earlier run"),
                    HasSubstr("of the other " + std::to_string(made))));
}

TEST_F(AnimateResumed, MakesAgainWhatWasTakenAway) {
  start_and_kill("out-004.obj");
  std::filesystem::remove(place("out-002.obj"));
  expect_success(words());
  expect_as_in_one_run();
}

TEST_F(AnimateResumed, MakesAgainWhatIsNotAsItWasWritten) {
  start_and_kill("out-004.obj");
  put("out-001.obj", "");
  std::string changed = get("out-002.obj");
  changed[changed.find("v ") + 2] = '7';
  put("out-002.obj", changed);
  const std::string progress = get("out-%03d.obj.progress");
  put("out-%03d.obj.progress", progress + "frame 99 12");  // the kill came while it was written
  expect_success(words());
  expect_as_in_one_run();
}

TEST_F(AnimateResumed, StartsOverWhereAFrameOrTheEditChanged) {
  for (const char* change : {"in-001.obj", "edit.yaml"}) {
    start_and_kill("out-004.obj");
    const std::string before = get(change);
    std::string after = before;
    after.replace(after.find(change[0] == 'i' ? "v 0 1" : "0.5]"), 4,
                  change[0] == 'i' ? "v 0 0.9" : "0.6]");
    put(change, after);
    const Ending ending = expect_success(words());
    EXPECT_THAT(ending.err, HasSubstr("starting over")) << change;
    EXPECT_THAT(ending.out, HasSubstr("150 of them made now")) << change;
    put(change, before);
  }
}

}  // namespace
}  // namespace deformlab::test
