#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/drawing_program.h"

// `output.page`: which part of the plane a picture of a drawing shows.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class DrawingPage : public DrawingProgram {
 protected:
  /// The bar of 120 × 80 pixels, of which one end leaves the page by about 20 pixels.
  Words bent(const std::string& out, const Words& more) const {
    put_bitmap("bar.png", bar());
    put_svg("bar.svg", "<rect x='10' y='25' width='100' height='30' fill='#c33'/>");
    put("edit.yaml",
        "edit:\n  - {select: {point: [15, 40]}, fix: true}\n"
        "  - {select: {point: [105, 40]}, by: [30, 0]}\n");
    Words words{"deform",     out.ends_with(".svg") ? "bar.svg" : "bar.png",
                "--edit",     "edit.yaml",
                "--out",      out,
                "--vertices", "60"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(DrawingPage, GrowsByDefaultAndOnlyWhereTheShapeLeavesIt) {
  const Ending ending = expect_success(bent("out.png", {}));
  const Bitmap out = read_png(place("out.png"));
  EXPECT_GT(out.width, 130);
  EXPECT_EQ(out.height, 80);
  EXPECT_THAT(ending.err, HasSubstr("to the right"));
}

TEST_F(DrawingPage, IsKept) {
  const Ending ending = expect_success(bent("out.png", {"output.page=keep"}));
  const Bitmap out = read_png(place("out.png"));
  EXPECT_EQ(out.width, 120);
  EXPECT_EQ(out.height, 80);
  EXPECT_EQ(out.pixel(119, 40)[3], 255);  // the bar goes on beyond the page
  EXPECT_THAT(ending.err, Not(HasSubstr("grew")));
  expect_success(bent("out.svg", {"output.page=keep"}));
  EXPECT_THAT(get("out.svg"), HasSubstr("viewBox=\"0 0 120 80\""));
}

TEST_F(DrawingPage, IsABoxInEitherForm) {
  for (const std::string box : {"[-10, 20, 150, 60]", "{min: [-10, 20], max: [150, 60]}"}) {
    expect_success(bent("out.png", {"output.page=" + box}));
    const Bitmap out = read_png(place("out.png"));
    EXPECT_EQ(out.width, 160);
    EXPECT_EQ(out.height, 40);
    EXPECT_EQ(out.pixel(25, 20)[0], 220);  // what is at (15, 40) stays
    EXPECT_EQ(out.pixel(15, 20)[3], 0);
    expect_success(bent("out.svg", {"output.page=" + box}));
    EXPECT_THAT(get("out.svg"), HasSubstr("viewBox=\"-10 20 160 40\""));
  }
  expect_success(bent("out.png", {"output.page=[-10, 20, 150, 60]", "output.resolution=2"}));
  EXPECT_EQ(read_png(place("out.png")).width, 320);
}

TEST_F(DrawingPage, IsThatOfThePanelsOfAPicture) {
  expect_success(bent("out.png", {"--picture", "p.png", "output.page=[0, 0, 200, 50]",
                                  "picture.width=400", "picture.rest=false"}));
  const Bitmap picture = read_png(place("p.png"));
  EXPECT_EQ(picture.width, 400);
  EXPECT_EQ(picture.height, 100 + 24);  // and the caption
  EXPECT_EQ(picture.pixel(100, 80)[0], 220);
}

TEST_F(DrawingPage, RefusesWhatIsNoPage) {
  using List = std::vector<std::pair<std::string, Words>>;
  for (const auto& [value, words] :
       List{{"shrink", {"grow", "keep", "[x0, y0, x1, y1]", "shrink"}},
            {"", {"grow", "keep"}},
            {"true", {"grow", "keep"}},
            {"[1, 2, 3]", {"[x0, y0, x1, y1]", "a list of 3"}},
            {"[0, 0, 0, 5]", {"x0 less than x1", "[0, 0, 0, 5]"}},
            {"[0, 0, -5, 5]", {"x0 less than x1", "[0, 0, -5, 5]"}},
            {"[0, 0, 2e6, 5]", {"1000000", "2e+06"}},
            {"[0, 0, .nan, 5]", {"output.page[2]", "finite number", ".nan"}},
            {"{min: [0, 0]}", {"grow", "max"}},
            {"{min: [0, 0, 0], max: [5, 5, 5]}", {"output.page.min", "[x, y]"}},
            {"{min: [0, 0], max: [5, 5], mid: 2}", {"mid", "known: min, max"}},
            {"[0, 0, 50000, 50000]", {"output.page", "50000×50000", "output.resolution"}}}) {
    expect_refused(bent("out.png", {"output.page=" + value}), words);
  }
  expect_refused(bent("out.png", {"output.grow=false"}), {"output.page"});
}

}  // namespace
}  // namespace deformlab::test
