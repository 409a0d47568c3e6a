#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "geometry/shape/shape_io.h"
#include "tests/support/animations.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"

// Edits that say more than where vertices go, as the commands take them.
namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kRings = 24;  // from x = 0 to x = 11.5

const std::string kFirst = "{select: {box: {min: [-1, -2, -2], max: [0.1, 2, 2]}}, fix: true}";
const std::string kEnd = "select: {box: {min: [11.4, -2, -2], max: [12, 2, 2]}}";

std::string edit(const std::string& entry) { return "edit: [" + kFirst + ", " + entry + "]\n"; }

std::string frame_name(const std::string& prefix, int frame) {
  return prefix + std::to_string(frame) + ".obj";
}

class EditCommand : public Program {
 protected:
  EditCommand() { put("in.obj", tube_frame(0, kRings)); }

  Shape deformed(const std::string& text, const Words& more = {}) const {
    put("edit.yaml", text);
    Words all{"deform", "in.obj", "--edit", "edit.yaml", "--out", "out.obj"};
    all.insert(all.end(), more.begin(), more.end());
    expect_success(all);
    return read_shape(place("out.obj"));
  }

  // Five frames of a tube that does not move, edited by keyframes at 0 and 4.
  Ending animate(const std::string& first, const std::string& last, const Words& more = {}) const {
    for (int f = 0; f < 5; ++f) put(frame_name("in-", f), tube_frame(0, kRings));
    put("keys.yaml", "pose: 0\nkeyframes:\n  - {frame: 0, edit: [" + kFirst + ", " + first +
                         "]}\n  - {frame: 4, edit: [" + last + "]}\n");
    Words all{"animate", "--frames", "in-%d.obj", "--edit", "keys.yaml", "--out", "out-%d.obj"};
    all.insert(all.end(), more.begin(), more.end());
    return start(all);
  }

  std::vector<Shape> animated(const std::string& first, const std::string& last) const {
    const Ending ending = animate(first, last);
    EXPECT_EQ(ending.status, 0) << ending.err;
    std::vector<Shape> frames;
    for (int f = 0; f < 5; ++f) frames.push_back(read_shape(place(frame_name("out-", f))));
    return frames;
  }
};

// The mean position of the last ring.
Eigen::Vector3d end_of(const Shape& shape) { return shape.V.rightCols(12).rowwise().mean(); }

// The angle of a vertex of the last ring about the axis of the tube [degree].
double angle_of_end(const Shape& shape) {
  const Eigen::Vector3d arm = shape.V.col(12 * kRings - 12) - end_of(shape);
  return std::atan2(arm.z(), arm.y()) * 180 / std::numbers::pi;
}

TEST_F(EditCommand, KeyframesTurnAlongAnArc) {
  const std::vector<Shape> frames =
      animated("{" + kEnd + ", by: [0, 0, 0]}",
               "{" + kEnd + ", rotate: {axis: [0, 1, 0], degrees: 120, center: [5.5, 0, 0]}}");
  for (const Shape& frame : frames) {
    EXPECT_NEAR((end_of(frame) - Eigen::Vector3d(5.5, 0, 0)).norm(), 6, 0.1);
  }
}

TEST_F(EditCommand, KeyframesTwistBeyondAHalfTurn) {
  const std::vector<Shape> frames = animated(
      "{" + kEnd + ", by: [0, 0, 0]}", "{" + kEnd + ", rotate: {axis: [1, 0, 0], degrees: 270}}");
  const Shape rest = read_shape(place("in-0.obj"));
  for (int f = 0; f < 5; ++f) {
    const double off = angle_of_end(frames[f]) - angle_of_end(rest) - 67.5 * f;
    EXPECT_NEAR(std::remainder(off, 360), 0, 2) << f;
    const Eigen::Matrix3Xd ring = frames[f].V.middleCols(6 * kRings, 12);  // near the middle
    const Eigen::Matrix3Xd arms = ring.colwise() - ring.rowwise().mean();
    EXPECT_GT(arms.colwise().norm().minCoeff(), 0.7) << "the tube does not collapse: " << f;
  }
}

TEST_F(EditCommand, ATurnThatAFrameCannotHoldIsTold) {
  const std::string first = "{" + kEnd + ", by: [0, 0, 0]}";
  const std::string last = "{" + kEnd + ", rotate: {axis: [1, 0, 0], degrees: 3600}}";
  const Ending strict = animate(first, last, {"--strict"});
  EXPECT_EQ(strict.status, 1);
  EXPECT_THAT(strict.err, AllOf(HasSubstr("does not hold a turn"), HasSubstr("--strict")));
  EXPECT_FALSE(exists("out-4.obj"));
  const Ending ending = animate(first, last);
  EXPECT_EQ(ending.status, 3);
  EXPECT_THAT(ending.err, AllOf(HasSubstr("not done: frame "), HasSubstr("does not hold a turn")));
  EXPECT_TRUE(exists("out-4.obj"));
}

TEST_F(EditCommand, FramesInAnotherOrderAreToldBeforeAnythingIsWritten) {
  for (int f = 0; f < 4; ++f) put(frame_name("in-", f), tube_frame(f));
  Shape other = read_shape(place("in-2.obj"));
  const Eigen::Matrix3Xd in_order = other.V;
  std::vector<int> order(other.V.cols());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  for (std::size_t i = 0; i < order.size(); ++i) {
    other.V.col(order[i]) = in_order.col(static_cast<int>(i));
  }
  for (auto& face : other.faces) {
    for (int& v : face) v = order[v];
  }
  other.N.resize(3, 0);
  write_shape(place("in-2.obj"), other);
  put("edit.yaml", kTubeEdit);
  const Words words{"animate", "--frames", "in-%d.obj", "--edit", "edit.yaml", "--out", "o-%d.obj"};
  const Ending ending = start(words);
  EXPECT_NE(ending.status, 0);
  EXPECT_THAT(ending.err, AllOf(HasSubstr("frame 2, 'in-2.obj'"), HasSubstr("another order")));
  EXPECT_FALSE(exists("o-0.obj"));
}

TEST_F(EditCommand, TargetsComeFromAFile) {
  put("to.csv", "vertex,x,y,z\n276,11.5,1,1\n279,11.5,0,2\n282,11.5,-1,1\n285,11.5,0,0\n");
  const Shape shape = deformed(edit("{targets: to.csv}"));
  EXPECT_LT((end_of(shape) - Eigen::Vector3d(11.5, 0, 1)).norm(), 0.1);
}

TEST_F(EditCommand, APartCanGrow) {
  const Shape shape = deformed(edit("{" + kEnd + ", scale: {factor: [1, 1.5, 1.5]}}"));
  const Eigen::Matrix3Xd ring = shape.V.rightCols(12);
  EXPECT_NEAR((ring.colwise() - ring.rowwise().mean()).colwise().norm().mean(), 1.5, 0.05);
}

TEST_F(EditCommand, PaintKeepsAPartRigid) {
  const std::string bend =
      edit("{" + kEnd + ", rotate: {axis: [0, 1, 0], degrees: 80, center: [5.75, 0, 0]}}");
  const Shape rest = read_shape(place("in.obj"));
  const auto error = [&](const Words& more) {  // of the distances between the rings in the middle
    const Shape shape = deformed(bend, more);
    double worst = 0;
    for (int i = 120; i < 156; ++i) {
      const double before = (rest.V.col(i + 12) - rest.V.col(i)).norm();
      worst = std::max(worst, std::abs((shape.V.col(i + 12) - shape.V.col(i)).norm() / before - 1));
    }
    return worst;
  };
  const double soft = error({});
  const double stiff = error({"paint=[{select: {box: {min: [4.9, -2, -2], max: [6.6, 2, 2]}}}]"});
  EXPECT_LT(stiff, 0.02);
  EXPECT_LT(stiff, 0.2 * soft);
}

TEST_F(EditCommand, SaysWhichMethodsTakeNoWeightAndNoPaint) {
  put("edit.yaml", edit("{" + kEnd + ", by: [0, 0, 1], weight: 3}"));
  const Words words{"deform", "in.obj", "--edit", "edit.yaml", "--out", "o.obj", "deformer=rbf"};
  expect_refused(words, {"leave 'weight' out"});
  put("edit.yaml", edit("{" + kEnd + ", by: [0, 0, 1]}"));
  Words painted = words;
  painted.push_back("paint=[{select: {all: true}}]");
  expect_refused(painted, {"'rbf' has no stiffness", "leave 'paint' out"});
  painted.back() = "paint=[{mask: m.png}]";
  expect_refused(painted, {"'mask' is for drawings"});
}

}  // namespace
}  // namespace deformlab::test
