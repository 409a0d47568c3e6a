#include "geometry/shape/shape_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/geometry/shape_files.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Values;

/// A quad, a pentagon and a repeated triangle over six vertices, one of which nothing uses.
Shape soup() {
  Shape shape;
  shape.V.resize(3, 6);
  shape.V << 0.1, 1, 1, 1.0 / 3, 1e-9, -7,  //
      0, 1e20, 1, 1, 2, 7,                  //
      0, 0.3, 0, -1, 2, 1e-300;
  shape.faces = {{0, 1, 2, 3}, {3, 2, 1, 0, 5}, {0, 1, 2}, {0, 1, 2}};
  return shape;
}

Eigen::Matrix3Xd some_normals(Eigen::Index count) {
  Eigen::Matrix3Xd N = Eigen::Matrix3Xd::Ones(3, count);
  for (Eigen::Index i = 0; i < count; ++i) N(0, i) = static_cast<double>(i);
  return N.colwise().normalized();
}

class EveryFormat : public ::testing::TestWithParam<const char*> {
 protected:
  fs::path target(const std::string& stem = "out") { return place(stem + GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(ShapeIo, EveryFormat, Values(".off", ".obj", ".ply", ".xyz", ".OFF"));

TEST_P(EveryFormat, KeepsEveryBitOfThePositions) {
  const Shape shape = soup();
  write_shape(target(), shape);
  const Shape back = read_shape(target());
  EXPECT_EQ(back.V, shape.V);
  EXPECT_EQ(back.N.cols(), 0);
  if (std::string(GetParam()) != ".xyz") {
    EXPECT_EQ(back.faces, shape.faces);
  }
}

TEST_P(EveryFormat, KeepsNormals) {
  Shape shape = soup();
  shape.N = some_normals(6);
  write_shape(target(), shape);
  EXPECT_TRUE(read_shape(target()).N.isApprox(shape.N, 1e-15));
}

TEST_P(EveryFormat, HoldsPointSets) {
  Shape shape = soup();
  shape.faces.clear();
  shape.N = some_normals(6);
  write_shape(target(), shape);
  const Shape back = read_shape(target());
  EXPECT_EQ(back.V, shape.V);
  EXPECT_TRUE(back.N.isApprox(shape.N, 1e-15));
  EXPECT_TRUE(back.faces.empty());
}

TEST_P(EveryFormat, OutMayBeTheSource) {
  Shape shape = soup();
  shape.N = some_normals(6);
  write_shape(target(), shape);
  shape = read_shape(target());
  shape.V *= -1.7;
  write_shape(target(), shape, target());
  const Shape back = read_shape(target());
  EXPECT_EQ(back.V, shape.V);
  EXPECT_EQ(back.faces, shape.faces);
  EXPECT_TRUE(back.N.isApprox(shape.N, 1e-15));
}

TEST_P(EveryFormat, LeavesOutNormalsThatTheShapeHasNot) {
  Shape shape = soup();
  shape.N = some_normals(6);
  write_shape(target(), shape);
  shape.N.resize(3, 0);
  write_shape(target("bare"), shape, target());
  const Shape back = read_shape(target("bare"));
  EXPECT_EQ(back.N.cols(), 0);
  EXPECT_EQ(back.V, shape.V);
  const Shape with_faces = read_shape(target());
  EXPECT_EQ(back.faces, with_faces.faces);
}

TEST_P(EveryFormat, CutAnywhereItIsReadOrRejected) {
  Shape shape = soup();
  shape.N = some_normals(6);
  write_shape(target(), shape);
  const std::string bytes = get(target());
  for (std::size_t size = 1; size < bytes.size(); size += 5) {
    const std::string said = reading(std::string("cut") + GetParam(), bytes.substr(0, size));
    EXPECT_EQ(said.find('\n'), std::string::npos);
    if (size < bytes.size() / 2 && std::string(GetParam()) == ".ply") {
      EXPECT_NE(said, "");
    }
  }
}

TEST_P(EveryFormat, RejectsWhatIsNoFile) {
  const fs::path missing = place("nowhere") / (std::string("x") + GetParam());
  EXPECT_THROW(read_shape(missing), InputError);
  fs::create_directories(target("folder"));
  EXPECT_THROW(read_shape(target("folder")), InputError);
  EXPECT_THAT(reading(std::string("empty") + GetParam(), ""), HasSubstr("it is empty"));
  EXPECT_NE(reading(std::string("blank") + GetParam(), "\n\n"), "");
}

TEST(ShapeIo, UnknownExtensionIsNamed) {
  EXPECT_THAT(reading("a.gltf", "x"), HasSubstr("unknown extension '.gltf'; known: .off"));
  EXPECT_THROW(write_shape(place("a.gltf"), soup()), InputError);
  EXPECT_THROW(write_shape(place("a.off"), soup(), place("a.gltf")), InputError);
}

TEST(ShapeIo, UnwritableFolderIsNamedAndNothingIsWritten) {
  const fs::path missing = place("missing") / "out.off";
  try {
    write_shape(missing, soup());
    FAIL() << "it wrote " << missing;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(missing.parent_path().string()));
  }
  const fs::path under_a_file = put("file", "x") / "out.off";
  EXPECT_THROW(write_shape(under_a_file, soup()), InputError);
  fs::create_directories(place("folder.off"));
  EXPECT_THROW(write_shape(place("folder.off"), soup()), InputError);
  EXPECT_EQ(get(place("file")), "x");
}

TEST(ShapeIo, AFailedWriteLeavesTheOldFile) {
  const fs::path out = put("out.off", "old");
  Shape shape = soup();
  shape.V(0, 2) = std::nan("");
  EXPECT_THROW(write_shape(out, shape), InputError);
  EXPECT_THROW(write_shape(out, soup(), place("missing.off")), InputError);
  EXPECT_EQ(get(out), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(out.parent_path()), {}), 1);
}

TEST(ShapeIo, WritingThroughALinkKeepsTheLink) {
  put("real.off", "old");
  fs::remove(place("link.off"));
  fs::create_symlink("real.off", place("link.off"));
  write_shape(place("link.off"), soup());
  EXPECT_TRUE(fs::is_symlink(place("link.off")));
  EXPECT_EQ(read_shape(place("real.off")).V, soup().V);
}

TEST(ShapeIo, RejectsASourceOfAnotherSize) {
  write_shape(place("a.off"), soup());
  Shape smaller = soup();
  smaller.V.conservativeResize(3, 5);
  smaller.faces.clear();
  try {
    write_shape(place("b.off"), smaller, place("a.off"));
    FAIL() << "it wrote 5 vertices in place of 6";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("5 vertices does not come from"));
  }
}

TEST(ShapeIo, AnotherFormatThanTheSourceTakesPositionsAndFaces) {
  write_shape(place("a.off"), soup());
  write_shape(place("b.ply"), soup(), place("a.off"));
  EXPECT_EQ(read_shape(place("b.ply")).faces, soup().faces);
}

}  // namespace
}  // namespace deformlab
