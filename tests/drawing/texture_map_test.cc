#include "drawing/bitmap/texture_map.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include "tests/support/drawings.h"

namespace deformlab {
namespace {

using test::disc;
using test::grid_mesh;

constexpr int kSize = 64;
const TextureView kView{.width = kSize, .height = kSize};

Bitmap drawn(const TextureMap& map, const Eigen::Matrix2Xd& V, const Eigen::VectorXd& depth = {}) {
  return map.draw(V, depth, kView);
}

/// The mesh cuts into the disc everywhere: what is drawn beyond it is the texture's too.
const Triangulation kInner = grid_mesh(7, {15, 15}, {47, 47});
/// The mesh covers all of the disc.
const Triangulation kOuter = grid_mesh(7, {3, 3}, {61, 61});

TEST(TextureMap, RestIsTheTextureToTheLastBit) {
  const Bitmap texture = disc(kSize, kSize, {32, 32}, 27);
  for (const Triangulation& mesh : {kInner, kOuter})
    EXPECT_EQ(drawn(TextureMap(texture, mesh), mesh.V).rgba, texture.rgba);
}

TEST(TextureMap, TranslationByWholePixelsIsExact) {
  const Bitmap texture = disc(kSize, kSize, {27, 32}, 22);
  const Eigen::Matrix2Xd V = kInner.V.colwise() + Eigen::Vector2d(3, -5);
  const Bitmap out = drawn(TextureMap(texture, kInner), V);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      for (int c = 0; c < 4; ++c) {
        const bool seen = x >= 3 && y < kSize - 5;
        ASSERT_EQ(out.pixel(x, y)[c], seen ? texture.pixel(x - 3, y + 5)[c] : 0) << x << " " << y;
      }
}

TEST(TextureMap, ResultDependsNeitherOnThreadsNorOnLuck) {
  const TextureMap map(disc(kSize, kSize, {32, 32}, 27), kInner);
  const Eigen::Matrix2Xd V = kInner.V.unaryExpr([](double x) { return x + 3 * std::sin(x / 5); });
  EXPECT_EQ(drawn(map, V).rgba, drawn(map, V).rgba);
}

/// The opacity at a place between four pixels' centres.
double opacity(const Bitmap& bitmap, const Eigen::Vector2d& place) {
  const Eigen::Vector2d low = (place.array() - 0.5).floor(),
                        part = place.array() - 0.5 - low.array();
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    const int x = int(low.x()) + i % 2, y = int(low.y()) + i / 2;
    if (x < 0 || y < 0 || x >= bitmap.width || y >= bitmap.height) continue;
    sum += (i % 2 ? part.x() : 1 - part.x()) * (i / 2 ? part.y() : 1 - part.y()) *
           bitmap.pixel(x, y)[3];
  }
  return sum;
}

TEST(TextureMap, RotationHasNoSeamsAndKeepsTheWholeRim) {
  const Bitmap texture = disc(kSize, kSize, {32, 28}, 25);
  const Eigen::Vector2d center(32, 32);
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(0.6).toRotationMatrix();
  for (const Triangulation& mesh : {kInner, kOuter}) {
    const Eigen::Matrix2Xd V = (R * (mesh.V.colwise() - center)).colwise() + center;
    const Bitmap out = drawn(TextureMap(texture, mesh), V);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const Eigen::Vector2d p(x + 0.5, y + 0.5);
        const Eigen::Vector2d source = R.transpose() * (p - center) + center;
        ASSERT_NEAR(out.pixel(x, y)[3], opacity(texture, source), 0.51) << x << " " << y;
      }
  }
}

TEST(TextureMap, ShrunkTextureIsAveraged) {
  Bitmap checks(kSize, kSize);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      std::fill_n(checks.pixel(x, y), 3, (x + y) % 2 == 0 ? 0 : 255);
      checks.pixel(x, y)[3] = 255;
    }
  const Triangulation mesh = grid_mesh(3, {0, 0}, {kSize, kSize});
  const Bitmap out = drawn(TextureMap(checks, mesh), mesh.V / 4);
  for (int y = 2; y < kSize / 4 - 2; ++y)
    for (int x = 2; x < kSize / 4 - 2; ++x) EXPECT_NEAR(out.pixel(x, y)[0], 128, 8);
}

/// Premultiplied means of n×n pixels, four rows of colours and alpha, 0 … 255.
Eigen::ArrayXXd means(const Bitmap& bitmap, int n) {
  const int width = bitmap.width / n, height = bitmap.height / n;
  Eigen::ArrayXXd result = Eigen::ArrayXXd::Zero(4, Eigen::Index{width} * height);
  for (int y = 0; y < height * n; ++y)
    for (int x = 0; x < width * n; ++x) {
      const std::uint8_t* p = bitmap.pixel(x, y);
      const double a = p[3] / 255.0;
      result.col(Eigen::Index{y / n} * width + x / n) +=
          Eigen::Array4d(a * p[0], a * p[1], a * p[2], p[3]) / (n * n);
    }
  return result;
}

TEST(TextureMap, ASmallPictureIsTheMeanOfTheLargeOne) {
  constexpr int kLarge = 256;
  Bitmap texture = disc(kLarge, kLarge, {128, 128}, 100);
  for (int y = 0; y < kLarge; ++y)  // a dark rim, as outlines have
    for (int x = 0; x < kLarge; ++x)
      if (Eigen::Vector2d(x - 127.5, y - 127.5).norm() > 94) std::fill_n(texture.pixel(x, y), 3, 0);
  const Triangulation mesh = grid_mesh(9, {60, 60}, {196, 196});
  Eigen::Matrix2Xd V = mesh.V;
  for (auto v : V.colwise())
    v += Eigen::Vector2d(6 * std::sin(v.y() / 30), 5 * std::cos(v.x() / 25));
  const TextureMap map(texture, mesh);
  constexpr int kSmall = kLarge / 4;
  const Eigen::ArrayXXd large = means(map.draw(V, {}, {kLarge, kLarge}), 4);
  const Eigen::ArrayXXd small =
      means(map.draw(V, {}, {.width = kSmall, .height = kSmall, .scale = 0.25}), 1);
  EXPECT_LT((large - small).abs().maxCoeff(), 4);
  const TextureView twice{.width = kLarge, .height = kLarge, .origin = {64, 64}, .scale = 2};
  const Eigen::ArrayXXd middle = means(map.draw(V, {}, twice), 8);
  for (int y = 0; y < kLarge / 8; ++y)
    for (int x = 0; x < kLarge / 8; ++x)
      EXPECT_LT((middle.col(Eigen::Index{y} * (kLarge / 8) + x) -
                 large.col(Eigen::Index{y + 16} * kSmall + x + 16))
                    .abs()
                    .maxCoeff(),
                8);
}

/// The left half folded over the right one about the line in the middle.
Eigen::Matrix2Xd folded(const Triangulation& mesh) {
  Eigen::Matrix2Xd V = mesh.V;
  for (auto v : V.colwise()) v.x() = std::max(v.x(), 64 - v.x());
  return V;
}

TEST(TextureMap, DepthTellsWhatIsInFront) {
  Bitmap halves(kSize, kSize);
  for (int y = 8; y < 56; ++y)
    for (int x = 8; x < 56; ++x) {
      halves.pixel(x, y)[x < 32 ? 0 : 2] = 255;
      halves.pixel(x, y)[3] = 255;
    }
  const Triangulation mesh = grid_mesh(9, {0, 0}, {64, 64});
  const TextureMap map(halves, mesh);
  for (const bool left_in_front : {false, true}) {
    Eigen::VectorXd depth(mesh.F.cols());
    for (Eigen::Index f = 0; f < depth.size(); ++f)
      depth[f] = (mesh.V(0, mesh.F(0, f)) + mesh.V(0, mesh.F(1, f)) < 64) == left_in_front ? 1 : 0;
    const Bitmap out = drawn(map, folded(mesh), depth);
    EXPECT_EQ(out.pixel(45, 30)[0], left_in_front ? 255 : 0);
    EXPECT_EQ(out.pixel(45, 30)[2], left_in_front ? 0 : 255);
    EXPECT_EQ(out.pixel(20, 30)[3], 0);
  }
}

TEST(TextureMap, NearbyLimbsDoNotGrowTogether) {
  // Two bars with a gap of three pixels, each with its own part of the mesh, joined at the top.
  Bitmap fork(kSize, kSize);
  for (int y = 8; y < 60; ++y)
    for (int x = 10; x < 53; ++x)
      if (y < 16 || x < 30 || x >= 33) std::fill_n(fork.pixel(x, y), 4, 255);
  Triangulation mesh{Eigen::Matrix2Xd(2, 10), Eigen::Matrix3Xi(3, 8)};
  mesh.V << 10, 30, 33, 53, 10, 30, 33, 53, 20, 43, 8, 8, 8, 8, 16, 16, 16, 16, 60, 60;
  mesh.F << 0, 0, 1, 1, 2, 2, 4, 6, 1, 5, 2, 6, 3, 7, 5, 7, 5, 4, 6, 5, 7, 6, 8, 9;
  Eigen::Matrix2Xd V = mesh.V;
  V.col(8).x() -= 6;
  V.col(9).x() += 6;
  const Bitmap out = drawn(TextureMap(fork, mesh), V);
  for (int y = 18; y < 56; ++y) EXPECT_EQ(out.pixel(31, y)[3], 0) << y;
}

TEST(TextureMap, CollapsedAndFarVerticesAreDrawnOrRefused) {
  const TextureMap map(disc(kSize, kSize, {32, 32}, 25), kInner);
  EXPECT_EQ(drawn(map, Eigen::Matrix2Xd::Constant(2, kInner.V.cols(), 30)).width, kSize);
  EXPECT_EQ(drawn(map, kInner.V * 1e12).width, kSize);
  EXPECT_EQ(drawn(map, kInner.V * 1e-12).width, kSize);
  EXPECT_NE(test::refusal([&] { drawn(map, kInner.V * std::nan("")); }), "");
}

}  // namespace
}  // namespace deformlab
