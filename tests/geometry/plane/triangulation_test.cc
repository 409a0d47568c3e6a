#include "geometry/plane/triangulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <functional>
#include <limits>
#include <numeric>
#include <set>

#include "tests/support/errors.h"
#include "tests/support/plane.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Edge = std::pair<int, int>;

Triangulation cut(const Region& region, int vertices, double uneven = 1) {
  return triangulate(region, {.vertices = vertices, .uneven = uneven}, "it");
}

std::string refused(const Region& region, const TriangulationOptions& options = {}) {
  return test::error_of([&] { triangulate(region, options, "it"); });
}

double area(const Triangulation& mesh, Eigen::Index t) {
  const Eigen::Matrix<double, 2, 3> c = mesh.V(Eigen::all, mesh.F.col(t));
  return ((c.rightCols<2>().colwise() - c.col(0)).determinant()) / 2;
}

double area(const Triangulation& mesh) {
  double sum = 0;
  for (Eigen::Index t = 0; t < mesh.F.cols(); ++t) sum += area(mesh, t);
  return sum;
}

/// Directed edges whose other direction no triangle has.
std::set<Edge> rim(const Triangulation& mesh) {
  std::set<Edge> edges;
  for (const auto& t : mesh.F.colwise()) {
    for (int k = 0; k < 3; ++k) {
      const Edge edge(t[k], t[(k + 1) % 3]);
      EXPECT_TRUE(edges.insert(edge).second) << "two triangles on one side of an edge";
    }
  }
  std::erase_if(edges, [all = edges](const Edge& e) { return all.contains({e.second, e.first}); });
  return edges;
}

double distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

double distance(const Eigen::Vector2d& p, const Eigen::Matrix2Xd& polygon) {
  double least = std::numeric_limits<double>::max();
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    least = std::min(least, distance(p, polygon.col(i), polygon.col((i + 1) % polygon.cols())));
  }
  return least;
}

double distance(const Eigen::Vector2d& p, const Region& region) {
  double least = distance(p, region.outline);
  for (const auto& hole : region.holes) least = std::min(least, distance(p, hole));
  return least;
}

int parts(const Triangulation& mesh) {
  std::vector<int> parent(mesh.V.cols());
  std::iota(parent.begin(), parent.end(), 0);
  const std::function<int(int)> root = [&](int v) {
    return parent[v] == v ? v : parent[v] = root(parent[v]);
  };
  for (const auto& t : mesh.F.colwise()) {
    parent[root(t[1])] = root(t[0]);
    parent[root(t[2])] = root(t[0]);
  }
  std::set<int> roots;
  for (int v = 0; v < static_cast<int>(parent.size()); ++v) roots.insert(root(v));
  return static_cast<int>(roots.size());
}

/// What any mesh of a region has to be.
void expect_mesh_of(const Region& region, const Triangulation& mesh) {
  for (Eigen::Index t = 0; t < mesh.F.cols(); ++t) ASSERT_GT(area(mesh, t), 0);
  EXPECT_EQ(parts(mesh), 1);  // an unused vertex would be another
  const std::set<Edge> boundary = rim(mesh);
  // Euler: one part with so many holes, each vertex of whose rim is passed once.
  const Eigen::Index edges = (3 * mesh.F.cols() + std::ssize(boundary)) / 2;
  EXPECT_EQ(mesh.V.cols() - edges + mesh.F.cols(), 1 - std::ssize(region.holes));
  std::set<int> starts;
  for (const Edge& edge : boundary) EXPECT_TRUE(starts.insert(edge.first).second);

  const double h = std::sqrt(2 * area(mesh) / double(mesh.F.cols()));  // about an edge
  for (const auto& [a, b] : boundary) {
    EXPECT_LT(distance(mesh.V.col(a), region), 0.15 * h);
    EXPECT_LT(distance((mesh.V.col(a) + mesh.V.col(b)) / 2, region), 0.15 * h);
  }
  EXPECT_NEAR(area(mesh) / area(checked(region, "it")), 1, 0.02);
}

struct Simple {
  std::string name;
  Region region;
};

std::vector<Simple> simple_regions() {
  return {{"disc", {circle({50, 50}, 40, 200), {}}},
          {"star", {star(5, 50), {}}},
          {"figure", figure()},
          {"ring", {circle({0, 0}, 100, 300), {circle({0, 0}, 60, 300)}}},
          {"strip", {box(0, 0, 400, 20), {}}}};
}

TEST(Triangulate, MeetsTheVertexCountWithNearEquilateralTriangles) {
  for (const auto& [name, region] : simple_regions()) {
    for (const int vertices : {80, 93, 150, 287, 1000}) {
      SCOPED_TRACE(name + ", " + std::to_string(vertices));
      const Triangulation mesh = cut(region, vertices);
      expect_mesh_of(region, mesh);
      // Edges as long as a hole of the figure is wide leave no choice.
      const bool has_room = name != "figure" || vertices >= 287;
      EXPECT_NEAR(double(mesh.V.cols()) / vertices, 1, has_room ? 0.03 : 0.15);
      EXPECT_GT(quality(mesh).least_angle, 20);
      EXPECT_GT(quality(mesh).mean, !has_room ? 0.8 : vertices < 1000 ? 0.9 : 0.95);
    }
  }
}

TEST(Triangulate, MeetsTwentyThousandVertices) {
  const Triangulation mesh = cut(figure(), 20000);
  EXPECT_NEAR(double(mesh.V.cols()), 20000, 200);
  EXPECT_GT(quality(mesh).least_angle, 20);
  EXPECT_GT(quality(mesh).mean, 0.96);
}

TEST(Triangulate, MakesEdgesOfSimilarLength) {
  const Triangulation mesh = cut({circle({0, 0}, 1, 300), {}}, 1000);
  std::vector<double> lengths;
  for (const auto& t : mesh.F.colwise()) {
    for (int k = 0; k < 3; ++k) {
      lengths.push_back((mesh.V.col(t[k]) - mesh.V.col(t[(k + 1) % 3])).norm());
    }
  }
  std::ranges::sort(lengths);
  EXPECT_LT(lengths[lengths.size() * 95 / 100] / lengths[lengths.size() * 5 / 100], 1.7);
  EXPECT_LT(lengths.back() / lengths.front(), 3.5);
}

TEST(Triangulate, KeepsSharpCornersAndIsGoodAwayFromThem) {
  const Region region{star(7, 25), {}};  // tips of 16°
  const Triangulation mesh = cut(region, 1000);
  expect_mesh_of(region, mesh);
  for (const auto& corner : region.outline.colwise()) {
    EXPECT_EQ((mesh.V.colwise() - corner).colwise().norm().minCoeff(), 0);
  }
  Triangulation away{mesh.V, Eigen::Matrix3Xi(3, 0)};
  for (const auto& t : mesh.F.colwise()) {
    if ((mesh.V(Eigen::all, t).colwise().norm().array() > 90).any()) continue;
    away.F.conservativeResize(3, away.F.cols() + 1);
    away.F.rightCols<1>() = t;
  }
  EXPECT_GT(quality(away).least_angle, 20);
  EXPECT_GT(quality(away).mean, 0.95);
}

TEST(Triangulate, TakesMoreVerticesWhereThinPartsNeedThem) {
  const Region strip{box(0, 0, 1000, 1), {}};
  const Triangulation mesh = cut(strip, 300);
  EXPECT_GT(mesh.V.cols(), 600);  // no triangle is wider than the strip
  EXPECT_GT(quality(mesh).least_angle, 20);
  expect_mesh_of(strip, mesh);
  const Triangulation fewest = cut({circle({0, 0}, 1, 100), {}}, 3);
  EXPECT_LT(fewest.V.cols(), 12);
}

TEST(Triangulate, MakesEdgesLongerOnTheRight) {
  const Region region{box(0, 0, 400, 100), {}};
  for (const double uneven : {0.1, 0.5, 4.0, 10.0}) {
    SCOPED_TRACE(uneven);
    const Triangulation mesh = cut(region, 2000, uneven);
    expect_mesh_of(region, mesh);
    EXPECT_NEAR(double(mesh.V.cols()), 2000, 60);
    EXPECT_GT(quality(mesh).least_angle, 20);
    // Area and number of triangles, away from where short edges have to grow into long ones.
    double left = 0, right = 0, on_left = 0, on_right = 0;
    for (Eigen::Index t = 0; t < mesh.F.cols(); ++t) {
      const double x = mesh.V(0, mesh.F.col(t)).mean();
      if (x < 100) left += area(mesh, t), ++on_left;
      if (x > 300) right += area(mesh, t), ++on_right;
    }
    EXPECT_NEAR(std::sqrt(right / on_right / (left / on_left)) / uneven, 1, 0.15);
  }
}

TEST(Triangulate, IsDeterministic) {
  const Triangulation one = cut(figure(), 2000, 3), other = cut(figure(), 2000, 3);
  EXPECT_EQ(one.V, other.V);
  EXPECT_EQ(one.F, other.F);
}

TEST(Triangulate, DoesNotDependOnTheUnit) {
  const Triangulation mesh = cut(figure(), 500);
  for (const double unit : {0x1p-100, 0x1p40}) {
    Region scaled = figure();
    scaled.outline *= unit;
    for (auto& hole : scaled.holes) hole *= unit;
    const Triangulation other = cut(scaled, 500);
    EXPECT_EQ(other.F, mesh.F);
    EXPECT_EQ(other.V, unit * mesh.V);
  }
}

TEST(Triangulate, IsAsGoodOnceTurnedAndMoved) {
  Region moved = figure();
  const auto move = [](Eigen::Matrix2Xd& p) {
    p = (rotation(0.7) * p).colwise() + Eigen::Vector2d(3e4, -7e5);
  };
  move(moved.outline);
  for (auto& hole : moved.holes) move(hole);
  const Triangulation mesh = cut(moved, 1000);
  EXPECT_NEAR(double(mesh.V.cols()), 1000, 30);
  EXPECT_GT(quality(mesh).least_angle, 20);
  EXPECT_GT(quality(mesh).mean, 0.95);
}

TEST(Triangulate, WorksOnAnyDrawing) {
  // Ragged, with many corners; with many holes that nearly touch; a tiny hole far from anything.
  Eigen::Matrix2Xd ragged = circle({0, 0}, 1, 6000);
  for (int i = 0; i < 6000; ++i) ragged.col(i) *= 100 + 5 * ((i * 7919) % 101) / 101.0;
  Region sieve{box(0, 0, 300, 300), {}};
  for (int i = 0; i < 81; ++i) {
    sieve.holes.push_back(circle({(i % 9) * 33 + 18.0, (i / 9) * 33 + 18.0}, 15, 30));
  }
  const Region pinhole{box(0, 0, 1, 1), {box(0.5, 0.5, 0.5 + 1e-6, 0.5 + 1e-6)}};
  for (const Region& region : {Region{ragged, {}}, sieve, pinhole}) {
    for (const int vertices : {3, 300}) {
      const Triangulation mesh = cut(region, vertices);
      EXPECT_EQ(parts(mesh), 1);
      const Eigen::Index edges = (3 * mesh.F.cols() + std::ssize(rim(mesh))) / 2;
      EXPECT_EQ(mesh.V.cols() - edges + mesh.F.cols(), 1 - std::ssize(region.holes));
      EXPECT_LT(mesh.V.cols(), 3000);
    }
  }
}

TEST(Triangulate, RefusesOptionsOutOfRange) {
  const Region region{box(0, 0, 9, 9), {}};
  EXPECT_EQ(refused(region, {.vertices = 2}), "vertices is 2; allowed: 0, or 3 to 200000");
  EXPECT_THAT(refused(region, {.vertices = 200001}), HasSubstr("vertices is 200001"));
  EXPECT_EQ(refused(region, {.uneven = 0}), "uneven is 0; allowed: 0.1 to 10");
  EXPECT_THAT(refused(region, {.uneven = 11}), HasSubstr("uneven"));
  EXPECT_THAT(refused(region, {.uneven = NAN}), HasSubstr("uneven"));
}

TEST(Triangulate, RefusesRegionsThatCannotBeMeshed) {
  EXPECT_THAT(refused({polygon({{0, 0}, {4, 4}, {4, 0}, {0, 4}}), {}}), HasSubstr("meets edge 2"));
  EXPECT_EQ(
      refused({box(0, 0, 1e6, 1), {}}),
      "cannot use 'it': its parts are so thin that good triangles would have more than 100000 "
      "vertices; make them thicker or leave them out");
  EXPECT_THAT(refused({box(0, 0, 1, 1), {box(1e-10, 0.3, 0.5, 0.6)}}),
              AllOf(HasSubstr("cannot use 'it': at (0, 0"),
                    HasSubstr("its boundary is less than 1e-09 from itself")));
  EXPECT_THAT(refused({box(1e12, 1e12, 1e12 + 1, 1e12 + 1), {}}), HasSubstr("to the origin"));
}

TEST(Quality, IsThatOfKnownTriangles) {
  const auto of = [](std::initializer_list<Eigen::Vector2d> corners) {
    return quality({polygon(corners), Eigen::Vector3i(0, 1, 2)});
  };
  const TriangleQuality equilateral = of({{0, 0}, {2, 0}, {1, std::sqrt(3)}});
  EXPECT_NEAR(equilateral.least_angle, 60, 1e-12);
  EXPECT_NEAR(equilateral.mean, 1, 1e-12);
  const TriangleQuality right = of({{0, 0}, {0, 5}, {5, 0}});  // turned over
  EXPECT_NEAR(right.least_angle, 45, 1e-12);
  EXPECT_NEAR(right.mean, 2 * (std::sqrt(2) - 1), 1e-12);
  const TriangleQuality flat = of({{0, 0}, {1, 0}, {3, 0}});
  EXPECT_EQ(flat.least_angle, 0);
  EXPECT_EQ(flat.mean, 0);
  Triangulation both{polygon({{0, 0}, {2, 0}, {1, std::sqrt(3)}, {4, 0}}), Eigen::Matrix3Xi(3, 2)};
  both.F << 0, 0, 1, 1, 2, 3;
  EXPECT_NEAR(quality(both).mean, 0.5, 1e-12);
  EXPECT_EQ(quality(both).least_angle, 0);
}

class Flat : public ::testing::Test {
 protected:
  Flat() { shape_ = to_shape(sheet(4, 3)); }

  std::string refused() const {
    return test::error_of([&] { flat(shape_, "it"); });
  }

  Shape shape_;
};

TEST_F(Flat, KeepsVerticesAndTriangles) {
  const Triangulation mesh = flat(shape_, "it");
  EXPECT_EQ(mesh.V, sheet(4, 3).V);
  EXPECT_EQ(mesh.F, sheet(4, 3).F);
  shape_.V.row(2).setConstant(-7);
  shape_.faces = {{0, 1, 5, 4}, {1, 2, 6, 5},  {2, 3, 7, 6},
                  {4, 5, 9, 8}, {5, 6, 10, 9}, {6, 7, 11, 10}};
  EXPECT_EQ(area(flat(shape_, "it")), 6);
}

TEST_F(Flat, TurnsBackWhatIsTurnedOver) {
  shape_.V.row(0) *= -1;
  const Triangulation mesh = flat(shape_, "it");
  EXPECT_EQ(mesh.V, shape_.V.topRows<2>());
  for (Eigen::Index t = 0; t < mesh.F.cols(); ++t) EXPECT_EQ(area(mesh, t), 0.5);
}

TEST_F(Flat, RefusesWhatIsNoFlatMesh) {
  shape_.V(2, 3) = 0.5;
  EXPECT_EQ(refused(),
            "cannot use 'it': it is not flat: z goes from 0 to 0.5; all vertices need the same z");
  shape_.V(2, 3) = 1e-9;
  EXPECT_EQ(refused(), "");
  std::swap(shape_.faces[4][0], shape_.faces[4][1]);
  EXPECT_THAT(refused(), HasSubstr("the triangle of vertices 3 2 7 (counted from 0) turns the o"));
  shape_.faces[4] = {2, 3, 3};
  EXPECT_THAT(refused(), HasSubstr("of vertices 2 3 3 (counted from 0) has no area"));
  shape_.faces.erase(shape_.faces.begin() + 4, shape_.faces.begin() + 6);
  EXPECT_THAT(refused(), HasSubstr("vertex 3 (counted from 0) is the corner of no triangle"));
  shape_.faces.clear();
  EXPECT_THAT(refused(), HasSubstr("it has no triangle"));
  shape_.faces = {{0, 1, 99}};
  EXPECT_NE(refused(), "");
  shape_ = {};
  EXPECT_NE(refused(), "");
}

TEST(Triangulation, TheNumberOfVerticesSuitsTheWidthOfTheLimbs) {
  EXPECT_EQ(suited_vertices({box(0, 0, 100, 100), {}}), 300);
  EXPECT_NEAR(suited_vertices({box(0, 0, 900, 3), {}}), 650, 20);  // edges of three, on both sides
  EXPECT_EQ(suited_vertices({box(0, 0, 9000, 3), {}}), 2000);
  EXPECT_NEAR(triangulate({box(0, 0, 900, 3), {}}, {}, "a line").V.cols(), 650, 50);
}

}  // namespace
}  // namespace deformlab::test
