#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/shape/formats/format.h"
#include "tests/geometry/shape_files.h"

namespace deformlab {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The file after its shape was read, doubled in size, its normals negated, and written.
std::string doubled(const std::string& name, const std::string& bytes) {
  const std::filesystem::path source = put(name, bytes);
  Shape shape = read_shape(source);
  shape.V *= 2;
  shape.N *= -1;
  const std::filesystem::path out = place("out_" + name);
  write_shape(out, shape, source);
  return get(out);
}

TEST(Off, KeepsCommentsColoursAndLayout) {
  EXPECT_EQ(doubled("a.off",
                    "COFF # made by hand\r\n3 1 0\r\n\r\n0 0 0 255 0 0 # red\r\n1 0 0 0 255 0\r\n"
                    "\t0 1.50 0   0 0 255\r\n3  0 1 2  9 9 9\r\n# end"),
            "COFF # made by hand\r\n3 1 0\r\n\r\n0 0 0 255 0 0 # red\r\n2 0 0 0 255 0\r\n"
            "\t0 3 0   0 0 255\r\n3  0 1 2  9 9 9\r\n# end");
}

TEST(Off, NormalsFollowTheShape) {
  EXPECT_EQ(doubled("a.off", "NOFF 1 0 0\n1 2 3 0 0 2 7\n"), "NOFF 1 0 0\n2 4 6 -0 -0 -1 7\n");
}

TEST(Off, SaysWhatIsWrong) {
  EXPECT_THAT(reading("a.off", "hello"), HasSubstr("does not begin with OFF"));
  EXPECT_THAT(reading("a.off", "OFF BINARY\n1 0 0\n"), HasSubstr("only the text ones"));
  EXPECT_THAT(reading("a.off", "4OFF\n1 0 0\n0 0 0 1\n"), HasSubstr("only the text ones"));
  EXPECT_THAT(reading("a.off", "OFF\n0 0 0\n"), HasSubstr("no vertices"));
  EXPECT_THAT(reading("a.off", "OFF\n-1 0 0\n"),
              AllOf(HasSubstr("line 2"), HasSubstr("numbers of vertices and faces")));
  EXPECT_THAT(reading("a.off", "# nothing\n"), HasSubstr("blanks and comments"));
  EXPECT_THAT(reading("a.off", "OFF\n2 0 0\n0 0 0\n"), HasSubstr("announces 2 vertices"));
  EXPECT_THAT(reading("a.off", "OFF\n2 0 0\n0 0 0\n0 x 0\n"), HasSubstr("vertex 1 (counted from"));
  EXPECT_THAT(reading("a.off", "OFF\n1 0 0\n0 nan 0\n"),
              HasSubstr("none of its 1 vertices has a position"));
  EXPECT_THAT(reading("a.off", "OFF\n1 0 0\n0 1e999 0\n"), HasSubstr("vertex 0"));
  EXPECT_THAT(reading("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 1\n"), HasSubstr("face 0"));
  EXPECT_THAT(reading("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0\n"), HasSubstr("face 0"));
  EXPECT_THAT(reading("a.off", "OFF\n1 1 0\n0 0 0\n999999999999 0\n"), HasSubstr("face 0"));
  EXPECT_THAT(reading("a.off", "OFF\n99999999999 9 0\n0 0 0\n"), HasSubstr("ends after 1"));
}

constexpr const char* kObj =
    "# by hand\nmtllib a.mtl\no thing\n"
    "v 1 2 3 0.5 0.25 1\nv 2 0 0\nv 0 2 0\nvt 0 0\nvt 1 0\n"
    "vn 0 0 1\nvn 0 1 0\nvn 1 0 0\ng left right\nusemtl red\ns off\n"
    "f 1/1/1 2/2/2 \\\n 3/1/3 # one\nf -3//-3 2//2 3//3\nl 1 2\n";

TEST(Obj, KeepsAllButPositionsAndNormals) {
  EXPECT_EQ(doubled("a.obj", kObj),
            "# by hand\nmtllib a.mtl\no thing\n"
            "v 2 4 6 0.5 0.25 1\nv 4 0 0\nv 0 4 0\nvt 0 0\nvt 1 0\n"
            "vn -0 -0 -1\nvn -0 -1 -0\nvn -1 -0 -0\ng left right\nusemtl red\ns off\n"
            "f 1/1/1 2/2/2 \\\n 3/1/3 # one\nf -3//-3 2//2 3//3\nl 1 2\n");
  const std::vector<std::vector<int>> faces = {{0, 1, 2}, {0, 1, 2}};
  EXPECT_EQ(read_shape(place("a.obj")).faces, faces);
}

TEST(Obj, SaysWhatIsWrong) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_THAT(reading("a.obj", "# nothing\n"), HasSubstr("no vertices, which are lines 'v x y z'"));
  EXPECT_THAT(reading("a.obj", "v 0 0\n"), HasSubstr("vertex 0"));
  EXPECT_THAT(reading("a.obj", v + "v 0 inf 0\n"), HasSubstr("vertex 3 (counted from 0), line 4"));
  EXPECT_THAT(reading("a.obj", v + "v 0 0,5 0\n"), HasSubstr("'0,5' is not a number"));
  EXPECT_THAT(reading("a.obj", v + "f 1 2 3\nf 1 2 4\n"),
              AllOf(HasSubstr("face 1 (counted from 0), line 5"), HasSubstr("no vertex 4"),
                    HasSubstr("the file has 3, counted from 1")));
  EXPECT_THAT(reading("a.obj", v + "f 1 2 -4\n"), HasSubstr("face 0"));
  EXPECT_THAT(reading("a.obj", v + "f 0 1 2\n"), HasSubstr("'0' is not an index"));
  EXPECT_THAT(reading("a.obj", v + "f 1 2 99999999999999999999\n"), HasSubstr("is not an index"));
}

constexpr const char* kPlyHeader =
    "ply\nformat FORMAT 1.0\ncomment by hand # yes\nobj_info more\nelement vertex 2\n"
    "property uchar red\nproperty float x\nproperty double y\nproperty float z\n"
    "property list uchar short tags\nproperty float nx\nproperty float ny\nproperty float nz\n"
    "property double quality\nelement face 1\nproperty list uchar ushort vertex_index\n"
    "property float weight\nelement material 1\nproperty int shine\nend_header\n";

TEST(Ply, KeepsColoursCustomPropertiesAndElementsOfText) {
  const std::string header = replaced(kPlyHeader, "FORMAT", "ascii");
  EXPECT_EQ(doubled("a.ply", header + "7 1 2 3 2 8 9 0 0 1 0.125\n8 -1 0.1 0 0 0 1 0 1e-3\n"
                                      "4 0 1 0 1 0.5\n3\n"),
            header +
                "7 2 4 6 2 8 9 -0 -0 -1 0.125\n8 -2 0.2 0 0 -0 -1 -0 1e-3\n"
                "4 0 1 0 1 0.5\n3\n");
}

/// The body of kPlyHeader with one list of two tags, positions times `scale` and normals times
/// `sign`.
std::string binary_body(bool swapped, double scale, float sign) {
  const auto f = [&](double value) { return raw(static_cast<float>(value), swapped); };
  const auto vertex = [&](unsigned char red, double x, double y, double z,
                          const std::string& tags) {
    return raw(red) + f(scale * x) + raw(scale * y, swapped) + f(scale * z) + tags + f(sign * 0) +
           f(sign * 0) + f(sign) + raw(0.125, swapped);
  };
  const auto index = [&](std::uint16_t value) { return raw(value, swapped); };
  return vertex(200, 1, 0.1, 3, std::string("\2", 1) + index(8) + index(9)) +
         vertex(201, -1, 2, 0.5, std::string("\0", 1)) + "\3" + index(0) + index(1) + index(0) +
         f(0.5) + raw(std::int32_t{3}, swapped);
}

TEST(Ply, KeepsColoursCustomPropertiesAndElementsOfBinary) {
  for (const bool swapped : {false, true}) {
    const std::string header =
        replaced(kPlyHeader, "FORMAT", swapped ? "binary_big_endian" : "binary_little_endian");
    EXPECT_EQ(doubled("a.ply", header + binary_body(swapped, 1, 1)),
              header + binary_body(swapped, 2, -1));
    const Shape shape = read_shape(place("a.ply"));
    EXPECT_EQ(shape.V.col(0), Eigen::Vector3d(1, 0.1, 3));
    EXPECT_EQ(shape.N.col(1), Eigen::Vector3d(0, 0, 1));
    EXPECT_EQ(shape.faces, (std::vector<std::vector<int>>{{0, 1, 0}}));
  }
}

TEST(Ply, LosesItsNormalsWithTheirProperties) {
  const std::string header = replaced(kPlyHeader, "FORMAT", "binary_big_endian");
  const auto source = put("a.ply", header + binary_body(true, 1, 1));
  Shape shape = read_shape(source);
  shape.N.resize(3, 0);
  write_shape(place("b.ply"), shape, source);
  EXPECT_EQ(get(place("b.ply")).size() + 3 * 18 + 2 * 12, get(source).size());
  EXPECT_EQ(read_shape(place("b.ply")).V, shape.V);
}

TEST(Ply, CutAnywhereItIsRejected) {
  for (const bool swapped : {false, true}) {
    const std::string header =
        replaced(kPlyHeader, "FORMAT", swapped ? "binary_big_endian" : "binary_little_endian");
    const std::string bytes = header + binary_body(swapped, 1, 1);
    for (std::size_t size = 1; size < bytes.size(); size += 3) {
      EXPECT_NE(reading("a.ply", bytes.substr(0, size)), "") << size;
    }
  }
}

TEST(Ply, SaysWhatIsWrong) {
  const std::string format = "ply\nformat ascii 1.0\n";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const auto points = [&](const std::string& count) {
    return format + "element vertex " + count + "\n" + xyz + "end_header\n";
  };
  EXPECT_THAT(reading("a.ply", "plyx\n"), HasSubstr("does not begin with ply"));
  EXPECT_THAT(reading("a.ply", "ply\nformat ascii 1.0\n"), HasSubstr("no end_header"));
  EXPECT_THAT(reading("a.ply", "ply\nformat morse 1.0\n"), HasSubstr("must be ascii"));
  EXPECT_THAT(reading("a.ply", format + xyz + "end_header\n"), HasSubstr("needs an element"));
  EXPECT_THAT(reading("a.ply", format + "end_header\n"), HasSubstr("one element called vertex"));
  EXPECT_THAT(reading("a.ply", format + "element vertex 1\nproperty int x\nend_header\n0\n"),
              HasSubstr("x as float or double"));
  EXPECT_THAT(reading("a.ply", points("0")), HasSubstr("no vertices"));
  EXPECT_THAT(reading("a.ply", points("2") + "0 0 0\n0 0"), HasSubstr("announces 2"));
  EXPECT_THAT(reading("a.ply", points("2") + "0 0 0\n0 inf 0"), HasSubstr("vertex 1"));
  EXPECT_THAT(reading("a.ply", points("1") + "0 1e39 0"), HasSubstr("not finite as float32"));
  EXPECT_THAT(reading("a.ply", points("9999999999999999") + "0 0 0\n"), HasSubstr("announces"));
  EXPECT_THAT(reading("a.ply", format + "element vertex 1\n" + xyz +
                                   "element face 1\nproperty list char int vertex_indices\n"
                                   "end_header\n0 0 0\n3 0 0 1\n"),
              HasSubstr("face 0 names vertex 1"));
}

TEST(Ply, InfinityInABinaryFileNamesTheVertex) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty double x\n"
      "property double y\nproperty double z\nend_header\n" +
      std::string(24, '\0');
  for (int i = 0; i < 3; ++i) bytes += raw(std::numeric_limits<double>::infinity());
  EXPECT_THAT(reading("a.ply", bytes), HasSubstr("vertex 1"));
}

TEST(Ply, TextNumbersHaveThePrecisionThatTheFileDeclares) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty double y\n"
      "property float z\nend_header\n0.10 0.10 1e-46\n";
  const auto source = put("a.ply", text);
  const Shape shape = read_shape(source);
  EXPECT_EQ(shape.V.col(0), Eigen::Vector3d(0.1F, 0.1, 0));
  write_shape(place("b.ply"), shape, source);
  EXPECT_EQ(get(place("b.ply")), text);
}

TEST(Ply, RejectsWhatItsPrecisionCannotHold) {
  const auto source = put("a.ply",
                          "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                          "property float y\nproperty float z\nend_header\n1 2 3\n");
  Shape shape = read_shape(source);
  shape.V *= 1e50;
  EXPECT_THROW(write_shape(place("b.ply"), shape, source), InputError);
  EXPECT_FALSE(std::filesystem::exists(place("b.ply")));
}

constexpr const char* kStl =
    "solid two # facets\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
    "   vertex 0 1 0\n  endloop\n endfacet\n facet normal 0 0 0\n  outer loop\n"
    "   vertex 1 0 0\n   vertex 1 1 0\n   vertex 0 1 0\n  endloop\n endfacet\nendsolid two\n";

TEST(Stl, EqualCornersBecomeOneVertexInOrderOfAppearance) {
  const Shape shape = read_shape(put("a.stl", kStl));
  Eigen::Matrix3Xd V(3, 4);
  V << 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0;
  EXPECT_EQ(shape.V, V);
  EXPECT_EQ(shape.faces, (std::vector<std::vector<int>>{{0, 1, 2}, {1, 3, 2}}));
  write_shape(place("binary.stl"), shape);
  const Shape back = read_shape(place("binary.stl"));
  EXPECT_EQ(back.V, shape.V);
  EXPECT_EQ(back.faces, shape.faces);
}

TEST(Stl, ZeroOfEitherSignIsOneCoordinate) {
  const Shape shape = read_shape(put("a.stl",
                                     "solid a\nfacet normal 0 0 1\nvertex 0 -0 0\nvertex 1 0 0\n"
                                     "vertex -0 0 -0\nendfacet\nendsolid a\n"));
  EXPECT_EQ(shape.faces, (std::vector<std::vector<int>>{{0, 1, 0}}));
  EXPECT_TRUE(std::signbit(shape.V(1, 0)));
}

TEST(Stl, KeepsNamesHeaderAndAttributes) {
  const std::string text = doubled("a.stl", kStl);
  EXPECT_THAT(text, HasSubstr("solid two # facets\n"));
  EXPECT_THAT(text, HasSubstr("  outer loop\n   vertex 2 0 0\n   vertex 2 2 0\n"));

  const auto source = place("b.stl");
  write_shape(source, read_shape(place("a.stl")));
  std::string bytes = replaced(get(source), std::string(5, '\0'), "solid");
  bytes[bytes.size() - 2] = 77;  // the last facet's attribute
  const std::string out = doubled("b.stl", bytes);
  EXPECT_EQ(out.substr(0, 84), bytes.substr(0, 84));
  EXPECT_EQ(out[out.size() - 2], 77);
  EXPECT_EQ(read_shape(place("out_b.stl")).V, 2 * read_shape(place("a.stl")).V);
}

TEST(Stl, SaysWhatIsWrong) {
  const std::string text = kStl;
  EXPECT_THAT(reading("a.stl", "solid a\nendsolid a\n"), HasSubstr("no vertices"));
  EXPECT_THAT(reading("a.stl", text.substr(0, text.rfind("endsolid"))), HasSubstr("endsolid"));
  EXPECT_THAT(reading("a.stl", replaced(text, "   vertex 0 1 0\n", "")), HasSubstr("3 vertices"));
  EXPECT_THAT(reading("a.stl", replaced(text, "vertex 1 1 0", "vertex 1 nan 0")),
              HasSubstr("facet 1"));
  EXPECT_THAT(reading("a.stl", std::string(80, ' ') + "\xff\xff\xff\xff"), HasSubstr("announces"));
  EXPECT_THAT(reading("a.stl", "x"), HasSubstr("too short"));
  for (const std::string facets : {"",
                                   "facet normal 0 0 1\nvertex 0 0 0\nvertex 1 0 0\n"
                                   "vertex 0 1 0\nendfacet\n"}) {
    EXPECT_THAT(reading("a.stl", "solid a\n" + facets + "vertex 1 2 3\nendsolid a\n"),
                HasSubstr("after its last facet"));
  }
}

TEST(Stl, CutAnywhereABinaryFileIsRejected) {
  const auto source = place("b.stl");
  write_shape(source, read_shape(put("a.stl", kStl)));
  const std::string bytes = get(source);
  for (std::size_t size = 1; size < bytes.size(); size += 3) {
    EXPECT_NE(reading("c.stl", bytes.substr(0, size)), "") << size;
  }
}

TEST(Stl, CannotHoldPoints) {
  Shape shape = read_shape(put("a.stl", kStl));
  shape.faces.clear();
  EXPECT_THROW(write_shape(place("b.stl"), shape), InputError);
  EXPECT_FALSE(std::filesystem::exists(place("b.stl")));
}

TEST(Xyz, KeepsCommentsCountAndFurtherColumns) {
  EXPECT_EQ(doubled("a.xyz", "2\n# by hand\n1 2 3  0 0 1 9\n4 5 6  0 1 0 8\n"),
            "2\n# by hand\n2 4 6  -0 -0 -1 9\n8 10 12  -0 -1 -0 8\n");
}

TEST(Xyz, ColoursAreNotNormals) {
  EXPECT_EQ(doubled("a.xyz", "1 2 3 255 0 10\n"), "2 4 6 255 0 10\n");
  EXPECT_EQ(doubled("a.xyz", "1 2 3 0.5\n"), "2 4 6 0.5\n");
}

TEST(Xyz, SaysWhatIsWrong) {
  EXPECT_THAT(reading("a.xyz", "# nothing\n"), HasSubstr("no vertices"));
  EXPECT_THAT(reading("a.xyz", "1 2\n"), HasSubstr("vertex 0"));
  EXPECT_THAT(reading("a.xyz", "1 2 3\n1 2\n"), HasSubstr("vertex 1 (counted from 0), line 2"));
  EXPECT_THAT(reading("a.xyz", "1 2 3\n1 2 x\n"), HasSubstr("'x' is not a number"));
  EXPECT_THAT(reading("a.xyz", "3\n1 2 3\n"), HasSubstr("announces 3 points"));
}

}  // namespace
}  // namespace deformlab
