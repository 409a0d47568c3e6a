#include <nlohmann/json.hpp>

#include "tests/support/animated_bar.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string pose(const std::string& at, const std::string& motion) {
  return "  - {at: " + at + ", edit: [{select: {point: [105, 40]}, " + motion + "}]}\n";
}

const std::string kPoses = "fps: 4\n" + std::string(kHeld) + "poses:\n" +
                           pose("[10, 10]", "by: [0, 0]") + pose("[110, 10]", "by: [-40, 30]") +
                           pose("[60, 70]", "by: [-20, -50]");

const std::string kHandles =
    "fps: 4\nhandles:\n  - {name: left, at: [15, 40]}\n  - {name: right, at: [105, 40]}\n"
    "performance: moves.csv\n";

const std::string kMoves =
    "time,handle,x,y\n0,left,15,40\n0,right,105,40\n0.5,right,95,60\n1,left,15,50\n1,right,105,"
    "40\n";

class AnimatePerformance : public AnimateDrawing {
 protected:
  AnimatePerformance() {
    put("keys.yaml", kPoses + "cursor: path.csv\n");
    put("path.csv", "time,x,y\n0,10,10\n1,110,10\n2,60,70\n3,60,70\n");
    put("moves.csv", kMoves);
  }

  Eigen::Vector2d end(int frame) const { return place_in(frame, {105, 40}); }
};

TEST_F(AnimatePerformance, ACursorMeetsEachPoseAtItsPoint) {
  const Ending ending = expect_success(words("o-%02d.obj"));
  EXPECT_THAT(ending.out, HasSubstr("13 frames"));
  EXPECT_THAT(ending.err, Not(HasSubstr("leaves the canvas")));
  EXPECT_LT((end(0) - Eigen::Vector2d(105, 40)).norm(), 1e-9);
  EXPECT_LT((end(4) - Eigen::Vector2d(65, 70)).norm(), 1e-9);
  EXPECT_LT((end(8) - Eigen::Vector2d(85, -10)).norm(), 1e-9);
  EXPECT_LT((end(2) - Eigen::Vector2d(85, 55)).norm(), 1e-6) << "three poses are blended affinely";
}

TEST_F(AnimatePerformance, APoseIsThatOfDeform) {
  expect_success(words("o-%02d.obj"));
  put("one.yaml", std::string(kHeld) + "  - {select: {point: [105, 40]}, by: [-40, 30]}\n");
  expect_success(
      {"deform", "bar.png", "--edit", "one.yaml", "--out", "one.obj", "--vertices", "60"});
  EXPECT_LT((read_flat("o-04.obj").V - read_flat("one.obj").V).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(AnimatePerformance, ACursorBeyondTheCanvasIsHeldAtTheLimit) {
  put("path.csv", "time,x,y\n0,150,10\n1,180,10\n2,900,10\n");
  const Ending ending = expect_success(words("o-%02d.obj"));
  EXPECT_THAT(ending.err,
              HasSubstr("the cursor leaves the canvas, which reaches from (0, 0) to (120, "
                        "80), to (150, 10) (line 2 of"));
  EXPECT_THAT(ending.err, HasSubstr("where the cursor is held"));
  EXPECT_LT((end(4) - end(8)).norm(), 1e-9) << "180 is the limit";
  EXPECT_GT((end(0) - end(4)).norm(), 1) << "poses are extrapolated before it";
}

TEST_F(AnimatePerformance, SeveralHandlesPlayBackAtOnce) {
  put("keys.yaml", kHandles);
  expect_success(words("o-%02d.obj"));
  EXPECT_LT((end(1) - Eigen::Vector2d(100, 50)).norm(), 1e-9);
  EXPECT_LT((end(2) - Eigen::Vector2d(95, 60)).norm(), 1e-9);
  EXPECT_LT((end(4) - Eigen::Vector2d(105, 40)).norm(), 1e-9);
  EXPECT_LT((place_in(2, {15, 40}) - Eigen::Vector2d(15, 45)).norm(), 1e-9);
}

TEST_F(AnimatePerformance, ItIsTheSameAsItsKeyframes) {
  put("keys.yaml", kHandles);
  put("moves.csv", "time,handle,x,y,angle\n0,left,15,40,\n0,right,105,40,0\n1,right,105,50,90\n");
  expect_success(words("a-%02d.obj"));
  put("keys.yaml",
      "fps: 4\nkeyframes:\n"
      "  - {time: 0, edit: [{select: {point: [15, 40]}, by: [0, 0]}, {select: {point: [105, 40]}, "
      "by: [0, 0]}]}\n"
      "  - {time: 1, edit: [{select: {point: [105, 40]}, by: [0, 10], rotate: 90}]}\n");
  expect_success(words("b-%02d.obj"));
  for (int frame = 0; frame <= 4; ++frame) {
    const Eigen::Matrix2Xd a = read_flat(name("a-", frame, ".obj")).V,
                           b = read_flat(name("b-", frame, ".obj")).V;
    EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-9) << frame;
  }
}

TEST_F(AnimatePerformance, AConfigMeasuresPosesAndShowsASequence) {
  std::string poses = kPoses.substr(kPoses.find("poses:"));
  for (std::size_t at = poses.find("  - "); at != std::string::npos;
       at = poses.find("  - ", at + 6))
    poses.insert(at, "  ");
  put("bar.yaml", "drawing: {file: bar.png, vertices: 60}\npicture: {width: 60}\n" +
                      std::string(kHeld) + "animation:\n  fps: 4\n  " + poses +
                      "  cursor: path.csv\n  pictured: 2\n  sequence: {every: 4, width: 60}\n");
  expect_success({"run", "bar.yaml", "--out", "results"});
  const auto m = nlohmann::json::parse(get("results/bar/metrics.json")).at("runs").at(0);
  EXPECT_EQ(m.at("metrics").at("poses_met"), 3);
  EXPECT_LT(m.at("metrics").at("pose_error").get<double>(), 1e-9);
  EXPECT_EQ(m.at("metrics").at("frames"), 13);
  EXPECT_TRUE(exists("results/bar/frames/0003.png") && !exists("results/bar/frames/0004.png"));
  EXPECT_EQ(get("results/bar/movie.webp").substr(8, 4), "WEBP");
  EXPECT_THAT(get("results/README.md"), HasSubstr("[all of them](bar/movie.webp)"));
}

/// One thing that `animate` must refuse of a performance, and what it must say.
struct BadPerformance {
  std::string name, file, text;
  Words says;
};

void PrintTo(const BadPerformance& bad, std::ostream* out) { *out << bad.name; }

class RefusesPerformance : public AnimatePerformance,
                           public ::testing::WithParamInterface<BadPerformance> {};

TEST_P(RefusesPerformance, WithAClearMessage) {
  const auto& [name, file, text, says] = GetParam();
  if (file == "moves.csv") put("keys.yaml", kHandles);
  put(file, text);
  expect_refused(words("f-%02d.png"), says);
}

BadPerformance bad_path(const std::string& name, const std::string& text, const Words& says) {
  return {name, "path.csv", text, says};
}
BadPerformance bad_moves(const std::string& name, const std::string& text, const Words& says) {
  return {name, "moves.csv", text, says};
}
BadPerformance bad_keys(const std::string& name, const std::string& text, const Words& says) {
  return {name, "keys.yaml", text, says};
}

INSTANTIATE_TEST_SUITE_P(
    Of, RefusesPerformance,
    ::testing::Values(
        bad_keys("OnePose", "poses:\n" + pose("[10, 10]", "by: [0, 0]") + "cursor: path.csv\n",
                 {"'poses' needs two or more entries, and it has 1"}),
        bad_keys("TwoPosesAtOnePoint",
                 kPoses + pose("[110, 10]", "by: [0, 3]") + "cursor: path.csv\n",
                 {"pose 2 (line", "pose 4 (line", "both at (110, 10)"}),
        bad_keys("NoCursor", kPoses, {"add 'cursor: FILE.csv'"}),
        bad_keys("NoPoses", "cursor: path.csv\n", {"'poses' needs two or more"}),
        bad_keys("APointOfThreeNumbers",
                 "poses:\n" + pose("[1, 2, 3]", "by: [0, 0]") + pose("[4, 5]", "by: [0, 1]") +
                     "cursor: path.csv\n",
                 {"pose 1", "'at' has 3 numbers"}),
        bad_keys("AHandleInSomePosesOnly",
                 kPoses + "  - {at: [0, 80], edit: [{select: {point: [60, 40]}, by: [0, 0]}]}\n" +
                     "cursor: path.csv\n",
                 {"pose 1 (line 5 of", "does not name the point (60, 40), which pose 4"}),
        bad_keys("KeyframesToo",
                 kPoses + "cursor: path.csv\nkeyframes:\n" + key("frame: 0", "by: [0, 0]"),
                 {"keep one of the three"}),
        bad_keys("NoCursorFile", kPoses + "cursor: none.csv\n", {"none.csv"}),
        bad_keys("ACursorThatIsAList", kPoses + "cursor: [a, b]\n", {"'cursor'", "a CSV file"}),
        bad_keys("NoPerformance", "handles: [{name: a, at: [15, 40]}]\n", {"give both of them"}),
        bad_keys("NoHandles", "performance: moves.csv\n", {"give both of them"}),
        bad_keys("TwoHandlesOfOneName", kHandles + "handles: [{name: a, at: [15, 40]}]\n",
                 {"handles"}),
        bad_keys("AHandleWithoutARow",
                 "handles: [{name: left, at: [15, 40]}, {name: right, at: [105, 40]}, {name: nose, "
                 "at: [60, 40]}]\nperformance: moves.csv\n",
                 {"no row of the handle 'nose'"}),
        bad_keys("TwoHandlesAtOnePlace",
                 "handles: [{name: left, at: [15, 40]}, {name: right, at: [15, 40]}]\n"
                 "performance: moves.csv\n",
                 {"'left'", "'right'", "the same place"}),
        bad_path("NoColumn", "time,x\n0,1\n1,2\n", {"line 1 of", "the column 'y' is missing"}),
        bad_path("Nothing", "\n\n", {"the column 'time' is missing"}),
        bad_path("OnlyAHeader", "time,x,y\n", {"has 0 rows", "two or more"}),
        bad_path("ANanInIt", "time,x,y\n0,1,2\n1,nan,2\n", {"line 3 of", "x is 'nan'", "finite"}),
        bad_path("AnInfinity", "time,x,y\n0,1,2\n1,2,1e999\n", {"line 3 of", "y is '1e999'"}),
        bad_path("AWord", "time,x,y\nsoon,1,2\n1,2,3\n", {"line 2 of", "time is 'soon'"}),
        bad_path("TooFewFields", "time,x,y\n0,1\n1,2,3\n", {"line 2 of", "has 2 fields"}),
        bad_path("TimesOutOfOrder", "time,x,y\n1,1,2\n0.5,2,3\n",
                 {"line 3 of", "time is 0.5, but 1"}),
        bad_path("EqualTimes", "time,x,y\n1,1,2\n1,2,3\n", {"line 3 of", "time is 1, but 1"}),
        bad_path("TimesBelowZero", "time,x,y\n-1,1,2\n1,2,3\n", {"line 2 of", "frame -4"}),
        bad_path("TimesBeyondAllFrames", "time,x,y\n1e30,1,2\n1.0000000001e30,2,3\n",
                 {"line 3 of", "at most 1000000000"}),
        bad_path("NoFrameBetween", "time,x,y\n0.1,1,2\n0.2,2,3\n", {"no frame lies between"}),
        bad_moves("AnUnknownHandle", kMoves + "2,rigth,1,2\n",
                  {"line 7 of", "unknown handle 'rigth'", "did you mean 'right'"}),
        bad_moves("NoColumnOfHandles", "time,x,y\n0,1,2\n", {"the column 'handle' is missing"}),
        bad_moves("ANanInMoves", kMoves + "2,left,1,nan\n", {"line 7 of", "y is 'nan'"}),
        bad_moves("AnAngleThatIsAWord", "time,handle,x,y,angle\n0,left,15,40,up\n",
                  {"line 2 of", "angle is 'up'"}),
        bad_moves("TwoRowsOfOneTime", kMoves + "1,left,1,2\n",
                  {"line 7 of", "'left' has two rows of time 1"}),
        bad_moves("MovesOutOfOrder", kMoves + "0.2,left,1,2\n",
                  {"line 7 of", "time is 0.2, but 1"})),
    [](const auto& test) { return test.param.name; });

TEST_F(AnimatePerformance, RefusesToWriteOverTheCursor) {
  expect_refused(words("f-%02d.png", {"--metrics", "path.csv"}), {"path.csv", "would replace"});
}

}  // namespace
}  // namespace deformlab::test
