#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/drawing_program.h"

// The panels of a picture of drawings.
namespace deformlab::test {
namespace {

using DrawingPictures = DrawingProgram;

// The number of columns from `begin` to `end` in which something is not white.
int columns_drawn(const Bitmap& picture, int begin, int end) {
  int count = 0;
  for (int x = begin; x < end; ++x) {
    bool drawn = false;
    for (int y = 0; y < picture.height; ++y) drawn = drawn || picture.pixel(x, y)[1] < 200;
    count += drawn ? 1 : 0;
  }
  return count;
}

TEST_F(DrawingPictures, DrawingsOfDifferentSizesFillTheirPanels) {
  put_bitmap("large.png", bar());
  Bitmap small(30, 20);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      std::copy_n(bar().pixel(4 * x, 4 * y), 4, small.pixel(x, y));
    }
  }
  put_bitmap("small.png", small);
  put("sizes.yaml",
      "title: two sizes\n"
      "edit:\n"
      "  - {select: {point: [0.25, 0.5]}, fix: true}\n"
      "picture: {width: 100, rest: false}\n"
      "sweep:\n"
      "  size:\n"
      "    large: {drawing.file: large.png, edit.0.select: {point: [15, 40]}}\n"
      "    small: {drawing.file: small.png, edit.0.select: {point: [4, 10]}}\n");
  const Ending ending = start({"run", "sizes.yaml"});
  ASSERT_EQ(ending.status, 0) << ending.err;
  const Bitmap picture = read_png(place("results/sizes/picture.png"));
  const int half = picture.width / 2;
  EXPECT_GT(columns_drawn(picture, 0, half), 60);
  EXPECT_NEAR(columns_drawn(picture, half, picture.width), columns_drawn(picture, 0, half), 10);
}

}  // namespace
}  // namespace deformlab::test
