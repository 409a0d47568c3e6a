#include <gtest/gtest.h>

#include "drawing/bound_drawing.h"
#include "drawing/write_drawing.h"
#include "tests/support/drawings.h"

// How vector drawings are read, and the pages and sizes of their pictures.
namespace deformlab::test {
namespace {

class VectorDrawings : public FolderTest {
 protected:
  Drawing read(const std::string& body, const std::string& size = "width='120' height='80'") const {
    return read_drawing(
        put("in.svg", "<svg xmlns='http://www.w3.org/2000/svg' " + size + ">" + body + "</svg>"),
        {});
  }
};

/// Whether the curve ends where it begins.
bool returns(const Curve& curve) {
  return curve.points.leftCols<1>() == curve.points.rightCols<1>();
}

TEST_F(VectorDrawings, ClosingLinesOfFillsAreCurves) {
  const std::string bar = "<rect x='10' y='25' width='100' height='30'/>";
  const Drawing fill = read(bar + "<path d='M 20 30 L 100 40 L 30 50' fill='#fff'/>");
  ASSERT_EQ(fill.paths.size(), 2u);
  const Curve& triangle = fill.paths[1].outlines.curves.at(0);
  EXPECT_TRUE(triangle.closed);
  EXPECT_TRUE(returns(triangle));
  EXPECT_GE((triangle.points.rightCols<1>() - triangle.points.rightCols<4>().col(0)).norm(), 1)
      << "the closing line has control points of its own";
}

TEST_F(VectorDrawings, AStrokeDoesNotFollowTheClosingLineOfItsFill) {
  const Drawing drawing =
      read("<path d='M 20 30 L 100 40 L 30 50 M 50 60 h 9 v 9 z' fill='#fff' stroke='#000'/>");
  ASSERT_EQ(drawing.paths.size(), 2u);
  const VectorPath &fill = drawing.paths[0], &stroke = drawing.paths[1];
  EXPECT_EQ(fill.number, stroke.number);
  EXPECT_EQ(fill.stroke.kind, Paint::Kind::kNone);
  EXPECT_EQ(stroke.fill.kind, Paint::Kind::kNone);
  EXPECT_TRUE(fill.outlines.curves.at(0).closed);
  EXPECT_FALSE(stroke.outlines.curves.at(0).closed);
  EXPECT_FALSE(returns(stroke.outlines.curves[0]));
  EXPECT_TRUE(stroke.outlines.curves.at(1).closed);
  const Drawing line = read("<path d='M 20 30 L 100 40 L 30 50' fill='none' stroke='#000'/>");
  ASSERT_EQ(line.paths.size(), 1u);
  EXPECT_FALSE(line.paths[0].outlines.curves.at(0).closed);
}

TEST_F(VectorDrawings, AFillWithoutAreaIsLeftOut) {
  // A line is filled with black unless it says otherwise. Bent, it would enclose something.
  const Drawing drawing = read("<path d='M 20 30 L 100 40 L 60 35' stroke='#f00'/>");
  ASSERT_EQ(drawing.paths.size(), 1u);
  EXPECT_FALSE(is_filled(drawing.paths[0]));
}

TEST_F(VectorDrawings, ClosingLinesOfClipsAreCurves) {
  const Drawing drawing = read(
      "<clipPath id='c'><path d='M 20 30 L 100 40 L 30 50'/></clipPath>"
      "<rect x='10' y='25' width='100' height='30' clip-path='url(#c)'/>");
  ASSERT_EQ(drawing.paths.size(), 1u);
  ASSERT_FALSE(drawing.paths[0].clips.empty());
  for (const Outlines& clip : drawing.paths[0].clips)
    EXPECT_TRUE(std::ranges::all_of(clip.curves, returns));
}

TEST_F(VectorDrawings, APageDoesNotGrowForWhatAClipHides) {
  // The bar turns about its middle, and with it the corners of the page, which the clip hides.
  for (const std::string what :
       {"<rect width='120' height='80'/>",
        "<path d='M 0 0 L 120 80' stroke='#000' stroke-width='40'/>",
        "<g clip-path='url(#d)'><rect width='120' height='80' stroke='#00f'/></g>"}) {
    const Drawing drawing = read(
        "<clipPath id='c'><rect x='30' y='30' width='60' height='20'/></clipPath>"
        "<clipPath id='d'><circle cx='60' cy='40' r='39'/></clipPath>"
        "<g clip-path='url(#c)'>" +
        what + "</g>");
    const Triangulation rest = grid_mesh(4, {30, 30}, {90, 50});
    const Eigen::Vector2d middle(60, 40);
    const Eigen::Matrix2Xd V =
        (Eigen::Rotation2Dd(0.5).toRotationMatrix() * (rest.V.colwise() - middle)).colwise() +
        middle;
    const Page page = BoundDrawing(drawing, rest).page_for(V, 1);
    EXPECT_TRUE(page.isApprox(drawing.page)) << what << page.min() << page.max();
    const Eigen::Matrix2Xd moved = rest.V.colwise() + Eigen::Vector2d(40, 0);
    EXPECT_GT(BoundDrawing(drawing, rest).page_for(moved, 1).max().x(), 125) << what;
  }
}

TEST_F(VectorDrawings, APngHasTheSizeOfThePage) {
  const std::string bar = "<rect x='20%' y='20%' width='60%' height='60%'/>";
  for (const int width : {16, 48, 199, 200, 640, 4000}) {
    const std::string size = std::to_string(width);
    const Drawing drawing = read(bar, "width='" + size + "' height='" + size + "'");
    EXPECT_EQ(resolution_of(drawing, {}), 1) << width;
  }
  const Drawing large = read(bar, "width='8000' height='2000'");
  EXPECT_EQ(resolution_of(large, {}), 0.5);
  const Triangulation rest = grid_mesh(4, {1600, 400}, {6400, 1600});
  const auto notes = write_drawing(place("out.png"), BoundDrawing(large, rest), rest.V, {},
                                   DrawingOutputOptions());
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("output.resolution=1"), std::string::npos);
}

TEST_F(VectorDrawings, FaintPixelsBelongToTheDrawing) {
  const Drawing drawing = read(
      "<rect x='10' y='25' width='60' height='30'/>"
      "<rect x='70' y='25' width='40' height='30' fill-opacity='0.3'/>");
  EXPECT_TRUE(shows(drawing, {40, 40}));
  EXPECT_TRUE(shows(drawing, {100, 40}));
  for (const Eigen::Vector2d& beside : {Eigen::Vector2d(100, 60), Eigen::Vector2d(-1, 40),
                                        Eigen::Vector2d(130, 40), Eigen::Vector2d(40, 90)})
    EXPECT_FALSE(shows(drawing, beside)) << beside.transpose();
}

}  // namespace
}  // namespace deformlab::test
