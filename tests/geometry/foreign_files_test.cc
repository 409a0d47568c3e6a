// Files as other programs write them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "geometry/core/files.h"
#include "tests/geometry/shape_files.h"

namespace deformlab {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Faces = std::vector<std::vector<int>>;
using Notes = std::vector<std::string>;

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

Notes notes_of(const std::string& name, const std::string& bytes) {
  Notes notes;
  read_shape(put(name, bytes), &notes);
  return notes;
}

Shape read(const std::string& name, const std::string& bytes) {
  return read_shape(put(name, bytes));
}

/// The file after a quarter turn about z.
std::string turned(const std::string& name, const std::string& bytes) {
  const std::filesystem::path source = put(name, bytes), out = place("out_" + name);
  Shape shape = read_shape(source);
  Eigen::Matrix3d R;
  R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  shape.V = (R * shape.V).eval();
  shape.N = (R * shape.N).eval();
  write_shape(out, shape, source);
  return get(out);
}

std::string with_breaks(const std::string& text, const std::string& line_break) {
  std::string result;
  for (const char c : text) c == '\n' ? result += line_break : result += c;
  return result;
}

TEST(ForeignFiles, MarksAndLineEndsChangeNothing) {
  const std::string stl =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid a\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"a.obj", std::string(kTriangle) + "f 1 2 3\n"},
      {"a.ply", ply},
      {"a.stl", stl},
      {"a.xyz", "0 0 0\n1 0 0\n0 1 0\n"}};
  for (const auto& [name, text] : files) {
    const Shape plain = read(name, text);
    for (const std::string line_break : {"\n", "\r", "\r\n"}) {
      for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
        const std::string bytes = mark + with_breaks(text, line_break);
        const Shape shape = read(name, bytes);
        EXPECT_EQ(shape.V, plain.V) << name;
        EXPECT_EQ(shape.faces, plain.faces) << name;
        write_shape(place("out_" + name), shape, place(name));
        EXPECT_FALSE(read_file(place("out_" + name)).starts_with("\xEF")) << name;
        EXPECT_THAT(notes_of(name, bytes), IsEmpty()) << name;
      }
    }
  }
}

TEST(ForeignFiles, MixedLineEndsAreEachOneLine) {
  EXPECT_EQ(read("a.obj", "v 0 0 0\rv 1 0 0\r\nv 0 1 0\nf 1 2 \\\r\n 3\rf 3 2 \\ \r 1").faces,
            (Faces{{0, 1, 2}, {2, 1, 0}}));
}

TEST(ForeignFiles, BinaryPlyWhoseHeaderEndsWithCarriageReturns) {
  const std::string header = with_breaks(
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar red\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n",
      "\r");
  const Shape shape = read("a.ply", header + "\n" + raw(1.F) + raw(2.F) + raw(3.F));
  EXPECT_EQ(shape.V.col(0), Eigen::Vector3d(1, 2, 3));
}

TEST(ForeignFiles, CommentsOfAnObjAreNotContinued) {
  const std::string text =
      std::string("# C:\\models\\\n") + kTriangle + "f 1 2 3 # C:\\\nf 3 2 1\n";
  EXPECT_EQ(read("a.obj", text).faces, (Faces{{0, 1, 2}, {2, 1, 0}}));
}

TEST(ForeignFiles, CornersOfAnObjMayEndWithSlashes) {
  const std::string v = std::string(kTriangle) + "vt 0 0\n";
  for (const std::string face : {"f 1// 2// 3//\n", "f 1/1/ 2/1/ 3/1/\n", "f 1/ 2/ 3/\n"}) {
    EXPECT_EQ(read("a.obj", v + face).faces, (Faces{{0, 1, 2}}));
    EXPECT_THAT(turned("a.obj", v + face), HasSubstr(face));
  }
}

TEST(ForeignFiles, SmallFacesAndUnknownLinesOfAnObjAreNamedOnceAndKept) {
  const std::string rest = "f 1 2\nf 1 2 3\nf 2 3\nsplat 1 2\nsplat 3\nhello\nvt nan 0\n";
  const std::string text = std::string("v 0 0 0 1\nv 1 0 0 0.5\nv 0 1 0 1 0 0\n") + rest;
  EXPECT_THAT(notes_of("a.obj", text),
              ElementsAre(HasSubstr("('hello', 'splat' 2 times)"), HasSubstr("(2) are kept")));
  EXPECT_EQ(read("a.obj", text).faces, (Faces{{0, 1, 2}}));
  EXPECT_EQ(turned("a.obj", text), "v 0 0 0 1\nv 0 1 0 0.5\nv -1 0 0 1 0 0\n" + rest);
}

TEST(ForeignFiles, ALineToAVertexWithoutAPositionKeepsItsNormal) {
  const std::string faces = "f 1//1 2//1 3//1\nf 4//1 1//1\n";
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan nan nan\nvn 1 0 0\n" + faces;
  EXPECT_THAT(turned("a.obj", text), ::testing::EndsWith(" 1 0\n" + faces));
}

TEST(ForeignFiles, NormalsThatAreNotFiniteStay) {
  const std::string text =
      std::string(kTriangle) + "vn nan nan nan\nvn 0 0 1\nvn 1 0 0\nf 1//1 2//2 3//3\n";
  EXPECT_THAT(notes_of("a.obj", text), ElementsAre(HasSubstr("1 of 3 normals")));
  EXPECT_THAT(turned("a.obj", text), HasSubstr("vn nan nan nan\nvn 0 0 1\nvn 0 1 0\n"));
}

TEST(ForeignFiles, PointsWithoutAPositionKeepTheirRows) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
      "property float y\nproperty float z\n";
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.xyz", "nan nan nan\n1 0 0\nnan nan nan\n0 2 0\n"},
      {"a.obj", "v nan nan nan\nv 1 0 0\nv nan nan nan\nv 0 2 0\n"},
      {"a.ply", head + "end_header\nnan nan nan\n1 0 0\nnan nan nan\n0 2 0\n"}};
  for (const auto& [name, text] : files) {
    EXPECT_THAT(notes_of(name, text), ElementsAre(HasSubstr("2 of 4 vertices have no position")));
    EXPECT_EQ(read(name, text).V.cols(), 2) << name;
    EXPECT_EQ(turned(name, text), replaced(replaced(text, "1 0 0", "0 1 0"), "0 2 0", "-2 0 0"))
        << name;
  }
}

TEST(ForeignFiles, AnotherFormatGetsTheRowsWithoutAPositionToo) {
  const auto source = put("a.obj", "v nan nan nan\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n");
  write_shape(place("out.off"), read_shape(source), source);
  EXPECT_EQ(get(place("out.off")), "OFF\n4 1 0\nnan nan nan\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n");
  write_shape(place("out.stl"), read_shape(source), source);
  EXPECT_EQ(read_shape(place("out.stl")).V.cols(), 3);
}

TEST(ForeignFiles, AFaceNeedsPositions) {
  EXPECT_THAT(reading("a.obj", std::string(kTriangle) + "v nan 0 0\nf 1 2 3\nf 1 2 4\n"),
              HasSubstr("face 1 names vertex 3"));
  EXPECT_THAT(reading("a.obj", std::string(kTriangle) + "v nan 0 0\nf 1 2 9\n"),
              HasSubstr("there is no vertex 9; the file has 4"));
  EXPECT_THAT(reading("a.xyz", "nan nan nan\n"), HasSubstr("none of its 1 vertices"));
}

TEST(ForeignFiles, NormalsOfCornersTurnAndGetCopiesOnlyWhereTheyMust) {
  const std::string rest = "f 1/1/1 2/1/1 3/1/2\n";
  const std::string text =
      std::string(kTriangle) + "vt 0 0\nvn 1 0 0\nvn 0 0 1\nvn 9 9 9\nvn 0 1 0\n" + rest;
  const std::string out = turned("a.obj", text);
  EXPECT_THAT(out, HasSubstr(rest));
  EXPECT_THAT(out, HasSubstr("vn 0 0 1\nvn 9 9 9\nvn 0 1 0\n"));

  // Two triangles apart: one turns, the other stays, and both name one normal.
  const auto source = put("b.obj", std::string(kTriangle) +
                                       "v 5 0 0\nv 6 0 0\nv 5 1 0\nvn 1 0 0\r\n"
                                       "f 1//-1 2//-1 3//-1\nf 4//1 5//1 6//-1");
  Shape shape = read_shape(source);
  EXPECT_EQ(shape.N.cols(), 0);
  for (int i = 3; i < 6; ++i) {
    shape.V.col(i) = Eigen::Vector3d(5 - shape.V(1, i), shape.V(0, i), 0);
  }
  write_shape(place("out.obj"), shape, source);
  const std::string copy = get(place("out.obj"));
  EXPECT_THAT(copy, HasSubstr("vn 1 0 0\r\nvn "));
  EXPECT_THAT(copy, HasSubstr("\r\nf 1//1 2//1 3//1\nf 4//2 5//2 6//2"));
}

TEST(ForeignFiles, CornersThatNameNoNormalAreNamed) {
  const std::string face = "f 1//1 2//7 3//-9\n";
  const std::string text = std::string(kTriangle) + "vn 0 0 1\n" + face;
  EXPECT_THAT(notes_of("a.obj", text), ElementsAre(HasSubstr("2 corners of faces name a normal")));
  EXPECT_THAT(turned("a.obj", text), HasSubstr(face));
}

TEST(ForeignFiles, VectorsAndQuaternionsOfAPlyTurn) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\n"
      "property double y\nproperty double z\nproperty double vx\n"
      "property double vy\nproperty double vz\n";
  for (int k = 0; k < 4; ++k) text += "property double rot_" + std::to_string(k) + "\n";
  text +=
      "property float f_rest_0\nproperty int mood\nelement camera 1\nproperty float f\n"
      "end_header\n";
  for (const char* p : {"0 0 0", "1 0 0", "0 1 0"}) text += std::string(p) + " 1 0 0 1 0 0 0 7 8\n";
  text += "9\n";
  EXPECT_THAT(notes_of("a.ply", text), ElementsAre(HasSubstr("('camera')"), HasSubstr("('mood')"),
                                                   HasSubstr("('f_rest_0')")));
  const std::string out = turned("a.ply", text);
  const std::string body = out.substr(out.find("end_header\n") + 11);
  std::istringstream numbers(body);
  std::vector<double> x(12);
  for (double& value : x) numbers >> value;
  const double half = std::sqrt(0.5);
  const std::vector<double> expected{0, 0, 0, 0, 1, 0, half, 0, 0, half, 7, 8};
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], expected[k], 1e-6) << k;
}

TEST(ForeignFiles, BinaryStlMaySaySolidAndHaveATail) {
  Shape shape = read("a.obj", std::string(kTriangle) + "f 1 2 3\n");
  write_shape(place("b.stl"), shape);
  std::string bytes = get(place("b.stl"));
  bytes.replace(0, 80, std::string("solid part").append(70, ' '));
  for (const std::string tail : {"", "\n", "\nendsolid\n"}) {
    const Notes notes = notes_of("c.stl", bytes + tail);
    EXPECT_EQ(notes.size(), tail.empty() ? 0u : 1u);
    EXPECT_EQ(read_shape(place("c.stl")).V, shape.V);
    EXPECT_THAT(turned("c.stl", bytes + tail), ::testing::EndsWith(tail));
  }
}

}  // namespace
}  // namespace deformlab
