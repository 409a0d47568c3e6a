#include "experiments/subjects/drawing/plane_shortfalls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/drawing_program.h"
#include "tests/support/drawings.h"

// What is said about parts of a drawing that are turned inside out.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// The words about a grid of 20 × 20 squares of which some vertices, by their rows, move to the
/// right by `way` sides of a square.
std::vector<std::string> words_for(int rows, double way) {
  DrawingScene scene;
  scene.rest = grid_mesh(21, {0, 0}, {20, 20});
  Eigen::Matrix2Xd V = scene.rest.V;
  for (int row = 10; row < 10 + rows; ++row) V(0, 21 * row + 10) += way;
  return inside_out(scene, V, Report{});
}

TEST(PlaneShortfalls, NamePartsThatAreInsideOut) {
  EXPECT_THAT(words_for(4, 0.9), IsEmpty());
  EXPECT_THAT(words_for(1, 1.5), IsEmpty()) << "1 of 800 triangles cannot be seen";
  const std::vector<std::string> words = words_for(4, 1.5);
  ASSERT_THAT(words, SizeIs(1));
  for (const char* word : {"% of the drawing is turned inside out", "of 800 triangles", "(1", "; "})
    EXPECT_THAT(words[0], HasSubstr(word));
}

class InsideOut : public DrawingProgram {
 protected:
  Ending turned_by(const std::string& degrees) const {
    put_bitmap("bar.png", bar());
    put("edit.yaml",
        "edit:\n  - {select: {point: [15, 40]}, fix: true}\n"
        "  - {select: {point: [60, 40]}, fix: true}\n"
        "  - {select: {point: [80, 40]}, rotate: " +
            degrees + "}\n");
    return start(
        {"deform", "bar.png", "--edit", "edit.yaml", "--out", "out.png", "--vertices", "200"});
  }
};

TEST_F(InsideOut, ADrawingThatTurnsHalfRoundOnItselfIsNotDone) {
  const Ending ending = turned_by("180");
  EXPECT_EQ(ending.status, 3);
  for (const char* word :
       {"not done", "of the drawing is turned inside out", "triangles", "handles less"})
    EXPECT_THAT(ending.err, HasSubstr(word));
  EXPECT_TRUE(exists("out.png"));
  const Ending gentle = turned_by("30");
  EXPECT_EQ(gentle.status, 0) << gentle.err;
  EXPECT_THAT(gentle.err, Not(HasSubstr("inside out")));
}

}  // namespace
}  // namespace deformlab::test
