#include <nlohmann/json.hpp>

#include "geometry/shape/shape_io.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class DeformCommand : public Program {
 protected:
  Shape shape(const std::string& name) const { return read_shape(place(name)); }

  Ending deform(const std::string& in, const std::string& edit, const Words& more = {}) const {
    put("edit.yaml", edit);
    Words all{"deform", in, "--edit", "edit.yaml", "--out", "out.off", "--nodes", "20"};
    all.insert(all.end(), more.begin(), more.end());
    return expect_success(all);
  }
};

class EveryFormat : public DeformCommand, public ::testing::WithParamInterface<std::string> {};

TEST_P(EveryFormat, KeepsOrderFacesAndFixedVertices) {
  const std::string in = "in" + GetParam(), out = "out" + GetParam();
  write_shape(place(in), bumpy_plane(9));
  deform(in, kLift, {"--out", out});
  const Shape before = shape(in), after = shape(out);
  ASSERT_EQ(after.V.cols(), before.V.cols());
  EXPECT_EQ(after.faces, before.faces);
  EXPECT_EQ(after.N.cols(), before.N.cols());
  for (Eigen::Index i = 0; i < before.V.cols(); ++i) {
    const Eigen::Vector3d motion = after.V.col(i) - before.V.col(i);
    if (before.V(0, i) == 0) {
      EXPECT_TRUE(motion.isZero(0)) << i << ": " << motion.transpose();
    }
    if (before.V(0, i) == 1) {
      EXPECT_NEAR(motion.z(), 0.3, 0.06) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, EveryFormat, ::testing::Values(".off", ".obj", ".ply", ".stl", ".xyz"),
                         [](const auto& test) { return test.param.substr(1); });

TEST_F(DeformCommand, KeepsWhatAnObjHoldsBeside) {
  std::string obj = "# by hand\nmtllib a.mtl\no tile\n",
              rest = "vt 0 0\nvt 1 0.5\ng left\nusemtl m\n";
  for (int i = 0; i < 9; ++i) {
    obj += "v " + std::to_string(i % 3) + " " + std::to_string(i / 3) + " 0\n";
  }
  rest += "f 1/1 2/2 5/1 4/2\ns off\ng right\nf 2/1 3/2 6/1\nl 7 8\n";
  put("in.obj", obj + rest);
  deform("in.obj", "edit:\n  - {select: {all: true}, by: [0, 0, 1]}\n", {"--out", "out.obj"});
  EXPECT_THAT(get("out.obj"), AllOf(HasSubstr("# by hand\nmtllib a.mtl\no tile\n"), HasSubstr(rest),
                                    Not(HasSubstr("v 0 0 0\n"))));
}

TEST_F(DeformCommand, KeepsThePropertiesOfAPly) {
  const std::string ply =
      "ply\nformat ascii 1.0\ncomment scanned\nelement vertex 4\nproperty double x\n"
      "property double y\nproperty double z\nproperty uchar red\nelement face 1\n"
      "property list uchar int vertex_indices\nproperty int material\nend_header\n";
  put("in.ply", ply + "0 0 0 10\n1 0 0 20\n1 1 0 30\n0 1 0 40\n4 0 1 2 3 77\n");
  deform("in.ply", "edit:\n  - {select: {all: true}, by: [2, 0, 0]}\n",
         {"--out", "out.ply", "--nodes", "4"});
  const std::string out = get("out.ply");
  EXPECT_THAT(out, AllOf(HasSubstr(ply), HasSubstr(" 10\n"), HasSubstr(" 40\n4 0 1 2 3 77\n")));
  EXPECT_NEAR(shape("out.ply").V(0, 2), 3, 1e-6);
}

TEST_F(DeformCommand, WritesAnotherFormat) {
  put("in.off", plane_off());
  deform("in.off", kLift, {"--out", "out.ply"});
  EXPECT_EQ(shape("out.ply").faces, shape("in.off").faces);
}

TEST_F(DeformCommand, MeasuresWhatItDid) {
  put("in.off", plane_off());
  const Ending ending = deform("in.off", kLift, {"--metrics", "m.json", "graph.nodes=15"});
  const auto m = nlohmann::json::parse(get("m.json"));
  EXPECT_EQ(m.at("solver"), "gauss_newton");
  EXPECT_EQ(m.at("nodes"), 15);
  EXPECT_GT(m.at("edges"), 14);
  EXPECT_GT(m.at("unknowns"), 0);
  EXPECT_GT(m.at("iterations"), 0);
  EXPECT_GT(m.at("min_det_R"), 0);
  EXPECT_LT(m.at("handle_rms"), 0.1);
  EXPECT_FALSE(m.at("blas").get<std::string>().empty());
  EXPECT_GE(m.at("threads"), 1);
  double sum = 0;
  for (const char* term : {"rotation", "regularization", "constraint"}) {
    sum += m.at("cost").at("by_term").at(term).get<double>();
  }
  EXPECT_NEAR(m.at("cost").at("total").get<double>(), sum, 1e-9 * sum);
  for (const char* phase : {"sample", "embed", "connect", "compile", "solve", "transfer"}) {
    EXPECT_GE(m.at("seconds").at(phase), 0) << phase;
  }
  EXPECT_THAT(ending.out, AllOf(HasSubstr("converged"), HasSubstr("15 nodes")));
}

TEST_F(DeformCommand, BothSolversAgree) {
  put("in.off", plane_off());
  deform("in.off", kLift, {"solver.epsilon=1e-12"});
  const Eigen::Matrix3Xd first = shape("out.off").V;
  deform("in.off", kLift, {"solver.epsilon=1e-12", "solver.method=ceres", "--metrics", "m.json"});
  EXPECT_EQ(nlohmann::json::parse(get("m.json")).at("solver"), "ceres");
  EXPECT_LT((shape("out.off").V - first).cwiseAbs().maxCoeff(), 1e-4);
}

TEST_F(DeformCommand, TheSameBytesTwice) {
  put("in.off", plane_off());
  deform("in.off", kLift, {"--picture", "p.png"});
  const std::string out = get("out.off"), picture = get("p.png");
  deform("in.off", kLift, {"--picture", "p.png"});
  EXPECT_EQ(get("out.off"), out);
  EXPECT_TRUE(get("p.png") == picture);
  EXPECT_EQ(picture.substr(1, 3), "PNG");
}

/// An edit that fixes some vertices, and which they are.
struct Selected {
  std::string name, select;
  std::vector<int> vertices;
  friend void PrintTo(const Selected& test, std::ostream* out) { *out << test.name; }
};
class EverySelector : public DeformCommand, public ::testing::WithParamInterface<Selected> {};

TEST_P(EverySelector, FixesExactlyWhatItSelects) {
  put("in.off", plane_off());
  put("some.txt", "0\n\n  9\r\n");
  deform("in.off", "edit:\n  - {select: {" + GetParam().select +
                       "}, fix: true}\n  - {select: {nearest: [2, 2, 0]}, by: [0, 0, 0.2]}\n");
  const Eigen::Matrix3Xd motion = shape("out.off").V - shape("in.off").V;
  for (const int i : GetParam().vertices) EXPECT_TRUE(motion.col(i).isZero(0)) << i;
  EXPECT_GT(motion(2, 80), 0.1);
}

INSTANTIATE_TEST_SUITE_P(
    Of, EverySelector,
    ::testing::Values(Selected{"Vertices", "vertices: [1, 0]", {0, 1}},
                      Selected{"Box", "box: {min: [0, 0, 0], max: [0.1, 0.2, 0]}", {0, 9}},
                      Selected{"Sphere", "sphere: {center: [0, 0, 0], radius: 0.13}", {0, 1, 9}},
                      Selected{"Nearest", "nearest: [-5, -5, 0]", {0}},
                      Selected{"File", "file: some.txt", {0, 9}}),
    [](const auto& test) { return test.param.name; });

/// A rigid motion of the whole: what it does to (1, 0, 0), vertex 8.
struct Moved {
  std::string name, action;
  Eigen::Vector3d place;
  friend void PrintTo(const Moved& test, std::ostream* out) { *out << test.name; }
};
class EveryAction : public DeformCommand, public ::testing::WithParamInterface<Moved> {};

TEST_P(EveryAction, MovesAllAsOneBody) {
  put("in.off", plane_off());
  deform("in.off", "edit:\n  - {select: {all: true}, " + GetParam().action + "}\n");
  const Shape before = shape("in.off"), after = shape("out.off");
  EXPECT_TRUE(after.V.col(8).isApprox(GetParam().place, 1e-6)) << after.V.col(8).transpose();
  EXPECT_NEAR((after.V.col(80) - after.V.col(0)).norm(), std::sqrt(2), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Of, EveryAction,
    ::testing::Values(Moved{"Fix", "fix: true", {1, 0, 0}}, Moved{"By", "by: [1, 2, 3]", {2, 2, 3}},
                      Moved{"To", "to: [5.5, 5.5, 1]", {6, 5, 1}},
                      Moved{"Rotate", "rotate: {axis: [0, 0, 2], degrees: 90}", {1, 1, 0}},
                      Moved{"RotateAboutAPoint",
                            "rotate: {axis: [0, 1, 0], degrees: 90, center: [0, 0, 0]}",
                            {0, 0, -1}},
                      Moved{"RotateThenMove",
                            "rotate: {axis: [0, 0, 1], degrees: 90}, by: [0, 0, 4]",
                            {1, 1, 4}}),
    [](const auto& test) { return test.param.name; });

/// A shape and an edit that are odd but have a result, and what the log says of them.
struct Odd {
  std::string name, bytes, edit, note;
  int nodes = 4;
  friend void PrintTo(const Odd& test, std::ostream* out) { *out << test.name; }
};
class Oddity : public DeformCommand, public ::testing::WithParamInterface<Odd> {};

TEST_P(Oddity, HasAFiniteResult) {
  const std::string in = GetParam().bytes.starts_with("OFF") ? "in.off" : "in.xyz";
  put(in, GetParam().bytes);
  put("edit.yaml", "edit:\n" + GetParam().edit);
  for (const std::string preset : {"sumner_2007", "default"}) {
    const Ending ending = start({"deform", in, "--edit", "edit.yaml", "--out", "out.off", "--nodes",
                                 std::to_string(GetParam().nodes), "preset=" + preset});
    if (preset == "sumner_2007") {
      EXPECT_THAT(ending.err, HasSubstr(GetParam().note));
    }
    if (ending.err.find("no handle can move") != std::string::npos) {
      EXPECT_EQ(ending.status, 2);
      continue;
    }
    EXPECT_THAT(ending.status, ::testing::AnyOf(0, 3)) << ending.err;  // 3: it is not done
    EXPECT_EQ(shape("out.off").V.cols(),
              shape(in).V.cols());  // read_shape refuses what is not finite
    std::filesystem::remove(place("out.off"));
  }
}

const char* const kOne = "  - {select: {vertices: [0]}, by: [0, 0, 1]}\n";
const char* const kTwo =
    "  - {select: {vertices: [0]}, fix: true}\n  - {select: {vertices: [1]}, by: [0, 0, 1]}\n";

std::string two_planes() {
  std::string text;
  for (int i = 0; i < 50; ++i) {
    text += std::to_string(i % 5 + i / 25 * 100) + " " + std::to_string(i / 5 % 5) + " 0\n";
  }
  return text;
}

INSTANTIATE_TEST_SUITE_P(
    Of, Oddity,
    ::testing::Values(
        Odd{"FewerNodesThanNeighbors", plane_off(), kOne, "fewer than neighbors + 1", 3},
        Odd{"ASingleNode", plane_off(), kOne, "fewer than neighbors + 1", 1},
        Odd{"MoreNodesThanVertices", plane_off(3), kTwo, "30 nodes for 9 vertices", 30},
        Odd{"ASingleHandle", plane_off(), kOne, "at one point only", 10},
        Odd{"HandlesInALine", plane_off(),
            "  - {select: {vertices: [0, 1, 2, 3]}, by: [0, 0, 1]}\n", "on one line only", 10},
        Odd{"AFreeComponent", two_planes(), kTwo, "has no handle: it stays where it is", 12},
        Odd{"NothingMoves", plane_off(), "  - {select: {all: true}, fix: true}\n", "", 10},
        Odd{"OneVertex", "1 2 3\n", kOne, "at one point only", 1},
        Odd{"TwoVertices", "1 2 3\n2 2 3\n", kTwo, "", 2},
        Odd{"AllVerticesInOnePlace", "1 2 3\n1 2 3\n1 2 3\n", kOne, "", 1},
        Odd{"CoincidentPoints", "0 0 0\n0 0 0\n1 0 0\n1 0 0\n0 1 0\n0 1 0\n1 1 0\n0 0 1\n", kOne,
            "", 5},
        Odd{"PointsInALine", "0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 0\n5 0 0\n6 0 0\n", kTwo, "", 6},
        Odd{"TrianglesWithoutArea",
            "OFF\n6 4 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 1\n3 0 0\n3 0 1 2\n3 0 1 3\n3 0 0 4\n"
            "3 5 5 5\n",
            kTwo, "", 6},
        Odd{"OnlyTrianglesWithoutArea",
            "OFF\n5 2 0\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 0\n3 0 1 2\n3 2 3 4\n", kTwo, "", 5},
        Odd{"FarFromTheOrigin",
            "1e12 1e12 0\n1000000000010 1e12 0\n1e12 1000000000010 0\n1e12 1e12 10\n", kTwo, "", 4},
        Odd{"Minute", "0 0 0\n1e-40 0 0\n0 1e-40 0\n0 0 1e-40\n1e-40 1e-40 0\n",
            "  - {select: {vertices: [0]}, by: [0, 0, 1e-40]}\n", "", 4},
        Odd{"Gigantic", "0 0 0\n1e40 0 0\n0 1e40 0\n0 0 1e40\n1e40 1e40 0\n",
            "  - {select: {vertices: [0]}, by: [0, 0, 1e40]}\n", "", 4}),
    [](const auto& test) { return test.param.name; });

TEST_F(DeformCommand, NamesManyFreeComponentsInFewLines) {
  put("in.off", plane_off());
  put("edit.yaml", "edit:\n" + std::string(kTwo));
  const Ending ending = start({"deform", "in.off", "--edit", "edit.yaml", "--out", "out.off",
                               "--nodes", "300", "preset=sumner_2007"});
  EXPECT_EQ(ending.status, 3);  // one vertex is torn off
  EXPECT_LT(std::ranges::count(ending.err, '\n'), 12) << ending.err;
  EXPECT_THAT(ending.err,
              HasSubstr("components without a handle that stay where they are, besides these: 32"));
}

TEST_F(DeformCommand, WritesNothingWhereTheSolverFails) {
  put("in.off", plane_off());
  put("edit.yaml", kLift);
  const auto before = contents();
  const Ending ending = start({"deform", "in.off", "--edit", "edit.yaml", "--out", "out.off",
                               "--metrics", "m.json", "energies.rotation=1e308"});
  EXPECT_EQ(ending.status, 1);
  EXPECT_THAT(ending.err, HasSubstr("the solver failed"));
  EXPECT_THAT(changes_since(before), ::testing::IsEmpty());
}

TEST_F(DeformCommand, WithoutALossIsAsIfThereWereNone) {
  put("in.off", plane_off());
  deform("in.off", kLift);
  const std::string plain = get("out.off");
  deform("in.off", kLift, {"losses.constraint.kind=none"});
  EXPECT_EQ(get("out.off"), plain);
  deform("in.off", kLift, {"losses.constraint={kind: cauchy, scale: 0.01}"});
  EXPECT_NE(get("out.off"), plain);
}

TEST_F(DeformCommand, TakesAnyNumberOfStepsAsTheMost) {
  put("in.off", plane_off());
  deform("in.off", kLift, {"solver.max_iterations=2147483647"});
}

TEST_F(DeformCommand, ReportsWhereItStoppedShort) {
  put("in.off", plane_off());
  const Ending ending = deform("in.off", kLift, {"solver.max_iterations=1"});
  EXPECT_THAT(ending.out, HasSubstr("max_iterations after 1 step"));
  EXPECT_THAT(ending.err, HasSubstr("max_iterations"));
}

// The plane in two halves along x, the right edge of which is lifted.
TEST_F(Program, ACutKeepsAPartFromFollowing) {
  put("plane.off", plane_off());
  put("edit.yaml", kLift);
  const std::string cut =
      "cut=[{between: {box: {min: [-1, -1, -1], max: [0.55, 2, 1]}}, "
      "and: {box: {min: [0.56, -1, -1], max: [2, 2, 1]}}}]";
  expect_success(
      {"deform", "plane.off", "--edit", "edit.yaml", "--out", "whole.off", "graph.nodes=20"});
  expect_success(
      {"deform", "plane.off", "--edit", "edit.yaml", "--out", "cut.off", "graph.nodes=20", cut});
  const auto height = [&](const char* file) {
    return read_shape(place(file)).V.col(4)[2];  // in the middle of the lower edge
  };
  EXPECT_GT(height("whole.off"), 0.02);
  EXPECT_NEAR(height("cut.off"), 0, 1e-6);
}

TEST_F(Program, RefusesCutsThatCannotBe) {
  put("plane.off", plane_off());
  put("edit.yaml", kLift);
  const auto refused = [&](const std::string& cut, const Words& words) {
    expect_refused({"deform", "plane.off", "--edit", "edit.yaml", "--out", "o.off",
                    "graph.nodes=20", "cut=" + cut},
                   words);
  };
  refused("[{between: {vertices: [1, 2]}, and: {vertices: [2, 3]}}]", {"cut 1", "both"});
  refused("[{between: {vertices: [1]}, and: {vertices: [999]}}]", {"cut 1", "999"});
  refused("[{between: {vertices: [1]}}]", {"and"});
  refused("[{between: {point: [0, 0, 0]}, and: {vertices: [3]}}]", {"cut 1"});
  refused("3", {"cut", "list"});
  expect_refused({"deform", "plane.off", "--edit", "edit.yaml", "--out", "o.off", "deformer=primo",
                  "cut=[{between: {vertices: [1]}, and: {vertices: [3]}}]"},
                 {"cut 1", "primo"});
}

}  // namespace
}  // namespace deformlab::test
