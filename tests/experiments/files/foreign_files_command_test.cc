// Commands on files as other programs write them.

#include <algorithm>

#include "geometry/shape/shape_io.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ForeignFiles : public Program {
 protected:
  ForeignFiles() { put("edit.yaml", kLift); }

  Ending deform(const std::string& in, const std::string& out) const {
    return start({"deform", in, "--edit", "edit.yaml", "--out", out, "--nodes", "20"});
  }

  std::string obj() const {
    Shape plane = bumpy_plane(9);
    plane.N.resize(3, 0);
    write_shape(place("plain.obj"), plane);
    return get("plain.obj");
  }
};

TEST_F(ForeignFiles, WhatAnObjHasBesidesIsNamedOnceAndKept) {
  put("in.obj", obj() + "f 1 2\nf 2 3\nsplat 7\nsplat 8\n");
  const Ending ending = deform("in.obj", "out.obj");
  EXPECT_EQ(ending.status, 0) << ending.err;
  EXPECT_THAT(ending.err, AllOf(HasSubstr("'splat' 2 times"), HasSubstr("one or two corners (2)")));
  EXPECT_THAT(get("out.obj"), HasSubstr("f 1 2\nf 2 3\nsplat 7\nsplat 8\n"));
}

TEST_F(ForeignFiles, PointsWithoutAPositionStayInTheirRows) {
  std::string text = "nan nan nan\n";
  const Shape plane = bumpy_plane(9);
  for (const auto p : plane.V.colwise()) {
    text += std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) +
            "\nnan nan nan\n";
  }
  put("in.xyz", text);
  const Ending ending = deform("in.xyz", "out.xyz");
  EXPECT_EQ(ending.status, 0) << ending.err;
  EXPECT_THAT(ending.err, HasSubstr("82 of 163 vertices have no position"));
  const std::string out = get("out.xyz");
  EXPECT_EQ(std::ranges::count(out, '\n'), 163);
  EXPECT_EQ(out.substr(0, 12), "nan nan nan\n");
  EXPECT_EQ(read_shape(place("out.xyz")).V.cols(), 81);
}

TEST_F(ForeignFiles, NormalsOfCornersTurnWithTheShape) {
  std::string text = obj(), flat;
  text.insert(0, "vn 0 0 1\n");
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    std::string line = text.substr(at, end - at);
    if (line.starts_with("f ")) {
      for (std::size_t c = 2; (c = line.find(' ', c)) != std::string::npos; c += 4) {
        line.insert(c, "//1");
      }
      line += "//1";
    }
    flat += line + "\n";
    at = end + 1;
  }
  put("in.obj", flat);
  const Ending ending = deform("in.obj", "out.obj");
  EXPECT_EQ(ending.status, 0) << ending.err;
  EXPECT_THAT(get("out.obj"), AllOf(HasSubstr("//1"), HasSubstr("//2"), HasSubstr("\nvn ")));
}

TEST_F(ForeignFiles, AnInputThatIsNotReadIsNamedRatherThanTheOutput) {
  put("in.gltf", "{}");
  put("in.svgz", "x");
  put("edit.yaml", "edit:\n  - {select: {all: true}, fix: true}\n");
  const Ending gltf = deform("in.gltf", "out.gltf"), svgz = deform("in.svgz", "out.svgz");
  EXPECT_EQ(gltf.status, 2);
  EXPECT_EQ(svgz.status, 2);
  EXPECT_THAT(gltf.err,
              AllOf(HasSubstr("cannot read 'in.gltf'"), HasSubstr(".off, .obj, .ply, .stl"),
                    HasSubstr(".png, .jpg, .jpeg, .webp, .svg"), Not(HasSubstr("cannot write"))));
  EXPECT_THAT(svgz.err, AllOf(HasSubstr("cannot read 'in.svgz'"), HasSubstr("unpack it"),
                              HasSubstr(".svg"), Not(HasSubstr("cannot write"))));
}

TEST_F(ForeignFiles, TablesMayHaveQuotesCapitalsPlusesAndLoneReturns) {
  std::string table = "\xEF\xBB\xBF\"Frame\", \"ID\",X,\" Y \",Z,\"a, name\"\r";
  for (int frame = 0; frame < 4; ++frame) {
    const std::string f = std::to_string(frame);
    table += f + ",+7,+" + f + ".5,\"0\", 0 ,\"b, \"\"c\"\"\"\r";
  }
  put("in.csv", table);
  put("edit.yaml", "edit:\n  - {select: {all: true}, by: [0, 1, 0]}\n");
  const Ending ending = start({"animate", "--particles", "in.csv", "--edit", "edit.yaml", "--out",
                               "out.csv", "--nodes", "4"});
  EXPECT_EQ(ending.status, 0) << ending.err;
  const std::string out = get("out.csv");
  EXPECT_EQ(out.substr(0, table.find('\r') + 1), table.substr(0, table.find('\r') + 1));
  EXPECT_EQ(std::ranges::count(out, '\r'), 5);
  EXPECT_THAT(out, AllOf(HasSubstr("\r3,+7,"), HasSubstr(",\"b, \"\"c\"\"\"\r")));
}

}  // namespace
}  // namespace deformlab::test
