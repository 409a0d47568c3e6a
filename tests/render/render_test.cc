#include "render/render.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

Shape square() {
  Shape shape;
  shape.V.resize(3, 4);
  shape.V << -1, 1, 1, -1, /**/ -1, -1, 1, 1, /**/ 0, 0, 0, 0;
  shape.faces = {{0, 1, 2, 3}};
  return shape;
}

RenderOptions from_above() {
  RenderOptions options{.width = 80, .height = 60, .samples = 2};
  options.camera.direction = {0, 0, -1};
  options.camera.up = {0, 1, 0};
  return options;
}

Image picture(const Panel& panel, const RenderOptions& options = from_above()) {
  return render(panel, frame(extent({panel}), options.camera, options.width, options.height),
                options);
}

bool white(const Image& image, int x, int y) {
  const std::uint8_t* p = image.pixel(x, y);
  return p[0] == 255 && p[1] == 255 && p[2] == 255;
}

int drawn(const Image& image) {
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) count += !white(image, x, y);
  return count;
}

std::string bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Render, ShapeCoversTheCenterUpToTheMarginFromEitherSide) {
  const Shape shape = square();
  RenderOptions options = from_above();
  for (const double z : {-1.0, 1.0}) {
    options.camera.direction.z() = z;
    const Image image = picture({.shape = &shape}, options);
    EXPECT_FALSE(white(image, 40, 30));
    EXPECT_TRUE(white(image, 0, 0));
    EXPECT_TRUE(white(image, 40, 1));  // the margin, 5% of 60 pixels
    EXPECT_FALSE(white(image, 40, 4));
    EXPECT_NEAR(drawn(image), 54 * 54, 120);
    EXPECT_GT(image.pixel(40, 30)[0], 60);
  }
}

TEST(Render, SameBytesWithAnyNumberOfThreadsAndAnyUnit) {
  Shape shape = square();
  shape.V(2, 2) = 0.7;
  const Panel panel{.shape = &shape, .balls = {{{0, 0, 0}, 0.1, colors::kHandle}}};
  RenderOptions options = from_above();
  options.threads = 1;
  const Image once = picture(panel, options);
  options.threads = 4;
  EXPECT_EQ(picture(panel, options).rgb, once.rgb);

  shape.V *= 1024;
  const Panel larger{.shape = &shape, .balls = {{{0, 0, 0}, 102.4, colors::kHandle}}};
  EXPECT_EQ(picture(larger, options).rgb, once.rgb);
}

TEST(Render, VertexColorsTintTheSurface) {
  const Shape shape = square();
  const Image image =
      picture({.shape = &shape, .vertex_colors = tinted(shape, {0, 1, 2, 3}, Color(0, 1, 0))});
  EXPECT_GT(image.pixel(40, 30)[1], 100);
  EXPECT_EQ(image.pixel(40, 30)[0], 0);
  EXPECT_THROW(tinted(shape, {4}), InputError);
  EXPECT_THROW(picture({.shape = &shape, .vertex_colors = Eigen::Matrix3Xd::Zero(3, 2)}),
               InputError);
}

TEST(Render, BallsAndSticksShowEvenSlightlyInside) {
  const Shape shape = square();
  const Color red(1, 0, 0);
  const Image ball = picture({.shape = &shape, .balls = {{{0, 0, -0.15}, 0.1, red}}});
  const Image stick =
      picture({.shape = &shape, .sticks = {{{-1, 0, -0.1}, {1, 0, -0.1}, 0.1, red}}});
  for (const Image* image : {&ball, &stick}) {
    EXPECT_GT(image->pixel(40, 30)[0], 150);
    EXPECT_LT(image->pixel(40, 30)[1], 20);
  }
  EXPECT_GT(ball.pixel(25, 30)[1], 60);
  EXPECT_LT(stick.pixel(25, 30)[1], 20);
}

TEST(Render, GraphIsBallsAtItsNodesAndSticksAlongItsEdges) {
  const Shape shape = square();
  const DeformationGraph graph{shape.V, {{0, 1, 1.0}, {1, 2, 1.0}}};
  Panel panel{.shape = &shape};
  add_graph(panel, graph, shape.V * 0.5, 0.06);
  ASSERT_EQ(panel.balls.size(), 4U);
  ASSERT_EQ(panel.sticks.size(), 2U);
  EXPECT_EQ(panel.sticks[1].b, shape.V.col(2) * 0.5);
  const Image image = picture(panel);
  EXPECT_GT(image.pixel(26, 43)[2], image.pixel(26, 43)[0] + 40);  // node 0
  EXPECT_GT(image.pixel(40, 43)[2], image.pixel(40, 43)[0] + 40);  // the edge from 0 to 1
  EXPECT_LT(image.pixel(40, 16)[2], image.pixel(40, 16)[0]);       // 2 and 3 share none
}

TEST(Render, DeepOverlayFadesOut) {
  const Shape shape = square();
  const Panel panel{.shape = &shape, .balls = {{{0, 0, -1}, 0.1, Color(1, 0, 0)}}};
  const Image image = picture(panel);
  const std::uint8_t* p = image.pixel(40, 30);
  EXPECT_LT(p[0] - p[1], 20);
}

TEST(Render, PointsWithoutFacesAreDots) {
  Shape shape;
  shape.V = Eigen::Matrix3Xd::Zero(3, 1);
  EXPECT_FALSE(white(picture({.shape = &shape}), 40, 30));

  shape.V.resize(3, 100);
  for (int i = 0; i < 100; ++i) {
    const int column = i % 10, row = i / 10;
    shape.V.col(i) << column, row, 0;
  }
  EXPECT_GT(drawn(picture({.shape = &shape})), 1000);
}

TEST(Render, DegenerateShapesAreDrawn) {
  Shape repeated;
  repeated.V = Eigen::Vector3d(1e6, -2, 3).replicate(1, 20);
  EXPECT_FALSE(white(picture({.shape = &repeated}), 40, 30));

  Shape flat = square();
  flat.faces = {{}, {0}, {0, 1}, {0, 0, 1}};
  EXPECT_GT(drawn(picture({.shape = &flat})), 0);
  flat.faces.push_back({0, 1, 2, 3});
  EXPECT_FALSE(white(picture({.shape = &flat}), 45, 35));
}

TEST(Render, NothingIsWhite) {
  EXPECT_EQ(drawn(picture({})), 0);
  const Image all = render_grid({Panel{}}, from_above());
  EXPECT_EQ(all.width, 80);
  EXPECT_EQ(drawn(all), 0);
}

TEST(Render, RefusesWhatIsNotFinite) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Shape shape = square();
  const Panel ball{.shape = &shape, .balls = {{{0, 0, 0}, kNan, colors::kNode}}};
  EXPECT_THROW(picture(ball), InputError);
  EXPECT_THROW(picture({.sticks = {{{0, 0, kNan}, {0, 0, 1}, 0.1, colors::kEdge}}}), InputError);
  const View view = frame(shape.V, from_above().camera, 80, 60);
  shape.V(1, 2) = kNan;
  EXPECT_THROW(render({.shape = &shape}, view, from_above()), InputError);
  EXPECT_THROW(picture({.shape = &shape}), InputError);
}

TEST(Render, RefusesAnImpossibleCamera) {
  RenderOptions options = from_above();
  options.camera.up = options.camera.direction;
  EXPECT_THROW(picture({}, options), InputError);
  options.camera = {.direction = {0, 0, 0}};
  EXPECT_THROW(picture({}, options), InputError);
  options.camera = {.field_of_view = 180};
  EXPECT_THROW(picture({}, options), InputError);
  options = from_above();
  options.width = 0;
  EXPECT_THROW(picture({}, options), InputError);
}

TEST(Render, PanelsShareTheCameraAndStandSideBySide) {
  const Shape small = square();
  Shape large = small;
  large.V *= 2;
  const Image all =
      render_grid({{.shape = &small, .caption = "before"}, {.shape = &large, .caption = "after"}},
                  from_above());
  const Image alone = picture({.shape = &large});
  const int half = all.width / 2;
  int left = 0, right = 0;
  for (int y = 0; y < alone.height - 4; ++y)
    for (int x = 0; x < half; ++x) {
      left += !white(all, x, y);
      right += !white(all, half + x, y);
    }
  EXPECT_NEAR(right, drawn(alone), 60);
  EXPECT_NEAR(left, right / 4.0, 60);
}

TEST(Render, APanelMayHaveACameraOfItsOwn) {
  const Shape shape = square();
  RenderOptions from_the_edge = from_above();
  from_the_edge.camera.direction = {0, 1, -0.1};
  from_the_edge.camera.up = {0, 0, 1};
  const Image flat = render_grid({{.shape = &shape}}, from_the_edge);
  const Image own = render_grid({{.shape = &shape, .camera = from_the_edge.camera}}, from_above());
  EXPECT_EQ(own.rgb, flat.rgb);
  const auto both = render_alike(
      {{.shape = &shape}, {.shape = &shape, .camera = from_the_edge.camera}}, from_above());
  EXPECT_LT(drawn(both[1]), drawn(both[0]) / 2);
}

TEST(Image, CaptionIsDrawnBelow) {
  const Image captioned = with_caption(Image(100, 50), "E = ½ ‖r‖²");
  EXPECT_EQ(captioned.width, 100);
  EXPECT_GT(captioned.height, 50);
  EXPECT_GT(drawn(captioned), 50);
  for (int x = 0; x < 100; ++x) EXPECT_TRUE(white(captioned, x, 49));
  const Image squeezed = with_caption(Image(100, 50), std::string(200, 'm'));
  for (int y = 0; y < squeezed.height; ++y) EXPECT_TRUE(white(squeezed, 0, y));
  EXPECT_THROW(with_caption(Image(100, 50), "\xff"), InputError);
}

TEST(Image, GridFillsRowsAndCentersWhatIsSmaller) {
  Image dark(4, 4);
  dark.rgb.assign(dark.rgb.size(), 0);
  const Image all = grid({Image(8, 8), dark, dark}, 2);
  EXPECT_EQ(all.width, 16);
  EXPECT_EQ(all.height, 12);
  EXPECT_EQ(drawn(all), 32);
  EXPECT_FALSE(white(all, 10, 2));
  EXPECT_FALSE(white(all, 2, 10));
  EXPECT_THROW(grid({}, 1), InputError);
  EXPECT_THROW(grid({dark}, 0), InputError);
}

TEST(Image, PngHasTheSameBytesEachTime) {
  const fs::path folder = fs::path(testing::TempDir()) / "deformlab_png";
  fs::create_directories(folder);
  const Image image = with_caption(Image(60, 40), "text");
  write_png(image, folder / "a.png");
  write_png(image, folder / "b.png");
  EXPECT_EQ(bytes(folder / "a.png").substr(1, 3), "PNG");
  EXPECT_EQ(bytes(folder / "a.png"), bytes(folder / "b.png"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2);
  fs::remove_all(folder);
}

TEST(Image, UnwritableTargetIsRefusedAndNothingIsLeft) {
  const fs::path folder = fs::path(testing::TempDir()) / "deformlab_unwritable";
  fs::create_directories(folder / "taken.png" / "inside");
  EXPECT_THROW(write_png(Image(4, 4), folder / "missing" / "a.png"), InputError);
  EXPECT_THROW(write_png(Image(4, 4), folder / "taken.png"), InputError);
  EXPECT_TRUE(fs::exists(folder / "taken.png" / "inside"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace deformlab
