#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/drawing_program.h"

// `deformlab deform` of drawings whose parts are detached, touch, or are thin.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

class DrawingParts : public DrawingProgram {
 protected:
  Words deform(const std::string& in, const std::string& edit, const std::string& out) const {
    put("edit.yaml", edit);
    return {"deform", in, "--edit", "edit.yaml", "--out", out};
  }
};

/// The bar with a square of 16 pixels, from (112, 32) on, beside its right end.
Bitmap bar_with_head() {
  Bitmap bitmap(140, 120);
  const Bitmap only = bar();
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 120; ++x) std::copy_n(only.pixel(x, y), 4, bitmap.pixel(x, y));
  for (int y = 32; y < 48; ++y)
    for (int x = 112; x < 128; ++x) {
      bitmap.pixel(x, y)[1] = 255;
      bitmap.pixel(x, y)[3] = 255;
    }
  return bitmap;
}

/// The number of green pixels.
int head_pixels(const Bitmap& bitmap, int top, int bottom) {
  int count = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = 0; x < bitmap.width; ++x)
      count += bitmap.pixel(x, y)[3] > 127 && bitmap.pixel(x, y)[1] > 200;
  return count;
}

TEST_F(DrawingParts, ADetachedPartFollowsWhatIsNearestToIt) {
  put_bitmap("two.png", bar_with_head());
  const Ending ending = expect_success(deform("two.png", kEdit, "out.png"));
  EXPECT_THAT(ending.err, ::testing::Not(HasSubstr("left out")));
  const Bitmap out = read_png(place("out.png"));
  EXPECT_NEAR(head_pixels(out, 0, out.height), 256, 12);
  EXPECT_NEAR(head_pixels(out, 44, 80), 256, 40) << "it goes down with the end of the bar";
}

TEST_F(DrawingParts, ADetachedPathOfAnSvgFollowsToo) {
  put_svg("two.svg",
          "<rect x='5' y='25' width='80' height='30'/>"
          "<rect x='88' y='32' width='16' height='16' fill='#0f0'/>");
  const std::string edit =
      "edit:\n  - {select: {point: [10, 40]}, fix: true}\n"
      "  - {select: {point: [80, 40]}, by: [0, 20]}\n";
  for (const char* name : {"out.png", "out.svg"}) {
    Words words = deform("two.svg", edit, name);
    words.emplace_back("output.resolution=1");
    expect_success(words);
  }
  EXPECT_NEAR(head_pixels(read_png(place("out.png")), 0, 80), 256, 12);
  EXPECT_THAT(get("out.svg"), HasSubstr("#00ff00"));
}

TEST_F(DrawingParts, ADetachedPartWithAHandleGoesItsOwnWay) {
  put_bitmap("two.png", bar_with_head());
  const std::string edit = std::string(kEdit) + "  - {select: {point: [120, 40]}, by: [0, 60]}\n";
  expect_success(deform("two.png", edit, "out.png"));
  const Bitmap out = read_png(place("out.png"));
  EXPECT_NEAR(head_pixels(out, 92, 108), 256, 4);
}

TEST_F(DrawingParts, DetachedPartsOfTheirOwnStayWithoutAHandle) {
  put_bitmap("two.png", bar_with_head());
  Words words = deform("two.png", kEdit, "out.png");
  words.emplace_back("drawing.parts=own");
  expect_success(words);
  EXPECT_NEAR(head_pixels(read_png(place("out.png")), 32, 48), 256, 4);
}

TEST_F(DrawingParts, DropsDetachedPartsIfAskedTo) {
  put_bitmap("two.png", bar_with_head());
  Words words = deform("two.png", kEdit, "out.png");
  words.emplace_back("drawing.parts=drop");
  EXPECT_THAT(expect_success(words).err, HasSubstr("kept the largest part"));
  EXPECT_EQ(head_pixels(read_png(place("out.png")), 0, 120), 0);
}

/// A forearm, from (44, 20) to (52, 60), beside a hip that begins at x = 52; both hang from a
/// shoulder, which is above y = 20.
Bitmap touching() {
  Bitmap bitmap(100, 100);
  for (int y = 10; y < 90; ++y)
    for (int x = 44; x < 80; ++x) {
      if (x < 52 && y >= 60) continue;
      std::uint8_t* p = bitmap.pixel(x, y);
      p[x < 52 && y >= 20 ? 0 : 2] = 255;
      p[3] = 255;
    }
  return bitmap;
}

TEST_F(DrawingParts, ACutFreesAForearmThatTouchesTheHip) {
  put_bitmap("touching.png", touching());
  const std::string edit =
      "edit:\n  - {select: {point: [65, 85]}, fix: true}\n"
      "  - {select: {point: [65, 30]}, fix: true}\n"
      "  - {select: {point: [47, 57]}, by: [-25, -12]}\n";
  Words words = deform("touching.png", edit, "out.png");
  words.emplace_back("cut=[[[52, 22], [52, 62]]]");
  expect_success(words);
  const Bitmap out = read_png(place("out.png"));
  EXPECT_EQ(out.pixel(22, 44)[0], 255);  // the hand is where it should be,
  EXPECT_EQ(out.pixel(54, 55)[2], 255);  // the hip stayed,
  EXPECT_EQ(out.pixel(43, 55)[3], 0);    // and between them is nothing.
  EXPECT_EQ(out.pixel(47, 55)[3], 0);
}

TEST_F(DrawingParts, RefusesCutsThatAreNoLines) {
  put_bitmap("bar.png", bar());
  for (const char* cut : {"cut=[[3, 4]]", "cut=[[[3, 4]]]", "cut=[{between: {all: true}}]"}) {
    Words words = deform("bar.png", kEdit, "out.png");
    words.emplace_back(cut);
    expect_refused(words, {"cut", "point"});
  }
  put("square.txt", "10 10\n90 10\n90 60\n10 60\n");
  Words words = deform("square.txt", kEdit, "out.png");
  words.emplace_back("cut=[[[3, 4], [5, 6]]]");
  expect_refused(words, {"square.txt", "leave 'cut' out"});
}

TEST_F(DrawingParts, AHandleOnTheRimHoldsTheNearestPlaceOfTheMesh) {
  Bitmap soft = bar();
  for (int x = 10; x < 110; ++x)
    for (int y = 55; y < 65; ++y)
      soft.pixel(x, y)[3] = static_cast<std::uint8_t>(110 - 10 * (y - 54));
  put_bitmap("soft.png", soft);
  const std::string edit =
      "edit:\n  - {select: {point: [15, 40]}, fix: true}\n"
      "  - {select: {point: [105, 60]}, by: [0, 15]}\n";
  expect_success(deform("soft.png", edit, "out.png"));
  EXPECT_EQ(read_png(place("out.png")).pixel(105, 62)[3], 255);
  expect_refused(deform("soft.png",
                        "edit:\n  - {select: {point: [15, 40]}, fix: true}\n"
                        "  - {select: {point: [105, 70]}, by: [0, 15]}\n",
                        "out.png"),
                 {"105", "70", "outside"});
}

TEST_F(DrawingParts, ALevelPutsASinglePartInFront) {
  put_bitmap("bar.png", bar());
  const std::string edit =
      "edit:\n  - {select: {point: [15, 40]}, fix: true}\n"
      "  - {select: {point: [60, 40]}, fix: true}\n"
      "  - {select: {point: [105, 40]}, to: [30, 42]}\n";
  for (const int level : {-1, 1}) {
    Words words = deform("bar.png", edit, "out.png");
    words.push_back("depth.parts=[{select: {box: {min: [62, 0], max: [120, 80]}}, level: " +
                    std::to_string(level) + "}]");
    expect_success(words);
    const Bitmap out = read_png(place("out.png"));
    EXPECT_EQ(out.pixel(30, 42)[level > 0 ? 2 : 0], 220) << level;
  }
}

TEST_F(DrawingParts, AThinLineKeepsItsWidth) {
  Bitmap line(200, 120);
  for (int y = 59; y < 62; ++y)
    for (int x = 10; x < 190; ++x) line.pixel(x, y)[3] = 255;
  put_bitmap("line.png", line);
  expect_success(deform("line.png",
                        "edit:\n  - {select: {point: [12, 60.5]}, fix: true}\n"
                        "  - {select: {point: [100, 60.5]}, by: [0, -30]}\n"
                        "  - {select: {point: [188, 60.5]}, fix: true}\n",
                        "out.png"));
  const Bitmap out = read_png(place("out.png"));
  for (int x = 30; x < 170; ++x) {
    double ink = 0;
    for (int y = 0; y < out.height; ++y) ink += out.pixel(x, y)[3] / 255.0;
    EXPECT_GT(ink, 2.6) << x;  // across, or more where the line is steep
    EXPECT_LT(ink, 4.2) << x;
  }
}

}  // namespace
}  // namespace deformlab::test
