#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/drawing_program.h"

// Cuts through the paths of a vector drawing.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

class DrawingCut : public DrawingProgram {
 protected:
  // Deforms in.svg.
  void deform(const std::string& edit, const std::string& cut, const std::string& out) const {
    put("edit.yaml", edit);
    expect_success({"deform", "in.svg", "--edit", "edit.yaml", "--out", out, "cut=" + cut,
                    "output.page=keep", "output.resolution=2"});
  }

  // What the SVG shows, drawn without a deformation.
  Bitmap seen(const std::string& svg) const {
    put("still.yaml", "edit:\n  - {select: {all: true}, fix: true}\n");
    expect_success({"deform", svg, "--edit", "still.yaml", "--out", "seen.png", "output.page=keep",
                    "output.resolution=2"});
    return read_png(place("seen.png"));
  }
};

bool is_dark(const Bitmap& bitmap, int x, int y) { return bitmap.pixel(x, y)[3] > 127; }

/// The number of squares of 3×3 pixels that belong to one of two pictures and not to the other.
/// Edges that are drawn in two ways have none.
int differences(const Bitmap& a, const Bitmap& b) {
  int count = 0;
  for (int y = 1; y + 1 < a.height; ++y)
    for (int x = 1; x + 1 < a.width; ++x) {
      bool all = true;
      for (int k = 0; k < 9 && all; ++k) {
        const int i = x - 1 + k % 3, j = y - 1 + k / 3;
        all = is_dark(a, i, j) != is_dark(b, i, j);
      }
      count += all;
    }
  return count;
}

/// A drawing on a page of 100 × 100 and an edit that opens a cut.
struct Opened {
  std::string name, body, cut, edit;
  friend void PrintTo(const Opened& test, std::ostream* out) { *out << test.name; }
};
class EveryCut : public DrawingCut, public ::testing::WithParamInterface<Opened> {};

TEST_P(EveryCut, ShowsInAnSvgWhatAPngShows) {
  put("in.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='100' height='100'>" +
                    GetParam().body + "</svg>");
  deform(GetParam().edit, GetParam().cut, "out.svg");
  deform(GetParam().edit, GetParam().cut, "out.png");
  const Bitmap png = read_png(place("out.png")), svg = seen("out.svg");
  ASSERT_EQ(png.width, svg.width);
  EXPECT_LT(differences(png, svg), 4);
}

std::string held(const std::string& at) { return "  - {select: {point: " + at + "}, fix: true}\n"; }
std::string moved(const std::string& at, const std::string& by) {
  return "  - {select: {point: " + at + "}, by: " + by + "}\n";
}

const std::string kDisc = "<circle cx='50' cy='50' r='40' fill='#08c'/>";
const std::string kArm =
    "edit:\n" + held("[65, 85]") + held("[65, 15]") + moved("[47, 57]", "[-25, -12]");
const std::string kArmCut = "[[[52, 20], [52, 64]]]";

INSTANTIATE_TEST_SUITE_P(
    Of, EveryCut,
    ::testing::Values(Opened{"AFill", kDisc, "[[[45, 45], [90, 95]]]",
                             "edit:\n" + held("[15, 50]") + moved("[75, 60]", "[10, -8]") +
                                 moved("[55, 80]", "[-5, 10]")},
                      Opened{"ACorner", kDisc, "[[[50, 30], [50, 100]], [[50, 30], [100, 30]]]",
                             "edit:\n" + held("[15, 50]") + moved("[75, 60]", "[10, 10]") +
                                 moved("[55, 20]", "[0, -5]")},
                      Opened{"ABentLine", kDisc, "[[[30, 50], [55, 40], [70, 65], [100, 60]]]",
                             "edit:\n" + held("[15, 50]") + moved("[80, 40]", "[0, -12]") +
                                 moved("[75, 75]", "[0, 10]")},
                      Opened{"AShortLine", "<rect width='100' height='100'/>",
                             "[[[96, 50], [101, 50]]]",
                             "edit:\n" + held("[15, 75]") + moved("[98, 46]", "[0, -4]") +
                                 moved("[98, 54]", "[0, 4]")},
                      Opened{"TwoPathsThatTouch",
                             "<rect x='44' y='20' width='8' height='40' fill='red'/>"
                             "<path d='M44 10H80V90H52V20H44Z' fill='blue'/>",
                             kArmCut, kArm},
                      Opened{"AFillWithAHole",
                             "<path fill-rule='evenodd' d='M10 10H90V90H10ZM40 40H60V60H40Z'/>",
                             "[[[50, 50], [50, 100]]]",
                             "edit:\n" + held("[20, 20]") + moved("[25, 80]", "[-8, 0]") +
                                 moved("[75, 80]", "[12, -5]")}),
    [](const auto& test) { return test.param.name; });

TEST_F(DrawingCut, SplitsFillsAndStrokesOfOnePath) {
  for (const std::string paint : {"fill='#f00'", "fill='none' stroke='#f00' stroke-width='6'",
                                  "fill='#f00' stroke='#f00' stroke-width='2'"}) {
    put("in.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='100' height='100'><path " +
                      paint + " d='M44 10H80V90H52V60H44Z' id='all'/></svg>");
    deform("edit:\n" + held("[65, 88]") + held("[65, 11]") + moved("[46, 59]", "[-25, -12]"),
           kArmCut, "out.svg");
    const Bitmap picture = seen("out.svg");
    EXPECT_GT(picture.pixel(42, 92)[3], 128) << "the hand is where it should be: " << paint;
    for (const int x : {84, 92, 98})
      EXPECT_EQ(picture.pixel(x, 110)[3], 0) << "nothing is between it and the hip: " << paint;
    EXPECT_THAT(get("out.svg"), HasSubstr("id=\"all\""));
  }
}

}  // namespace
}  // namespace deformlab::test
