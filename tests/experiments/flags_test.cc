#include "tests/support/program.h"
#include "tests/support/scenes.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

TEST_F(Program, FlagsOfLibrariesAreUnknown) {
  put("flags.txt", "--flagfile=flags.txt\n");
  for (const std::string flag : {"flagfile=flags.txt", "fromenv=nodes", "tryfromenv=nodes",
                                 "undefok=a", "helpxml", "log_dir=/", "tab_completion_word=a"}) {
    expect_refused({"help", "--" + flag}, {"unknown flag '--" + flag, "known: out, edit"});
  }
}

TEST_F(Program, TheVersionIsACommandAndAFlag) {
  const std::string version = expect_success({"version"}).out;
  EXPECT_THAT(version, MatchesRegex("deformlab [0-9.]+ \\(commit .*\\)\n"));
  EXPECT_EQ(expect_success({"--version"}).out, version);
  EXPECT_EQ(expect_success({"-version"}).out, version);
  EXPECT_EQ(expect_success({"deform", "x.off", "--version"}).out, version);
  expect_refused({"versio"}, {"did you mean 'version'?"});
}

/// Numbers that are none, in every kind of text.
TEST_F(Program, AWrongNumberIsNamedWithItsLine) {
  put("edit.yaml", kLift);
  put("s.off", plane_off());
  const std::pair<std::string, std::string> files[] = {
      {"a.off", "OFF\n3 1 0\n0 0 0\n+-1 0 0\n0 1 0\n3 0 1 2\n"},
      {"f.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 +-1 2\n"},
      {"c.off", "OFF\n3 +-1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 +-1 0\nf 1 2 3\n"},
      {"f.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 +-2 3\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
       "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
       "0 0 0\n1 0 0\n0 +-1 0\n3 0 1 2\n"},
      {"f.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
       "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
       "0 0 0\n1 0 0\n0 1 0\n3 0 +-1 2\n"},
      {"h.ply", "ply\nformat ascii 1.0\nelement vertex +-3\nproperty float x\nend_header\n"},
      {"a.xyz", "0 0 0\n1 +-1 0\n0 1 0\n"},
      {"a.stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 +-1 0\nvertex 0 1 0\n"
       "endloop\nendfacet\nendsolid a\n"}};
  for (const auto& [name, text] : files) {
    SCOPED_TRACE(name);
    put(name, text);
    const std::string ending = name.substr(1);
    expect_refused({"deform", name, "--edit", "edit.yaml", "--out", "out" + ending},
                   {name, "line ", "+-"});
  }
  put("p.txt", "0 0\n9 0\n9 +-9\n");
  put("bend.yaml", "edit:\n  - {select: {all: true}, by: [0, 0]}\n");
  expect_refused({"deform", "p.txt", "--edit", "bend.yaml", "--out", "o.png"}, {"p.txt", "line 3"});
  put("g.obj", "v 0 0 0\nv 1 0 +-1\nl 1 2\n");
  expect_refused({"deform", "s.off", "--edit", "edit.yaml", "--out", "o.off", "graph.method=file",
                  "graph.file=g.obj"},
                 {"g.obj", "line 2", "+-1"});
  put("in.csv", "frame,id,x,y,z\n0,0,0,0,0\n0,1,+-1,0,0\n");
  expect_refused({"animate", "--particles", "in.csv", "--edit", "edit.yaml", "--out", "o.csv"},
                 {"line 3", "+-1"});
  put("t.csv", "7, 0, 0, 0\n8, 0, +-1, 0\n");
  put("i.txt", "1\n+-2\n");
  put("targets.yaml", "edit:\n  - {targets: t.csv}\n");
  put("file.yaml", "edit:\n  - {select: {file: i.txt}, fix: true}\n");
  for (const std::string edit : {"targets", "file"}) {
    expect_refused({"deform", "s.off", "--edit", edit + ".yaml", "--out", "o.off"},
                   {"line 2", "+-"});
  }
  put("number.yaml", "edit:\n  - {select: {nearest: [0, 0, 0]}, by: [0, +-1, 0]}\n");
  expect_refused({"deform", "s.off", "--edit", "number.yaml", "--out", "o.off"}, {"line 2", "+-1"});
}

/// The vertex that an edit fixes is the one that stays.
TEST_F(Program, SelectionsFarAwayDoNotOverflow) {
  put("s.off", plane_off());
  const auto moved = [&](const std::string& select) {
    put("edit.yaml", "edit:\n  - {select: {vertices: [40]}, fix: true}\n  - {select: " + select +
                         ", by: [0, 0, 0.01]}\n");
    return start({"deform", "s.off", "--edit", "edit.yaml", "--out", "o.off", "--nodes", "20"});
  };
  const auto out_of = [&](const std::string& select) {
    const Ending ending = moved(select);
    EXPECT_THAT(ending.status, ::testing::AnyOf(0, 3)) << ending.err;
    return get("o.off");
  };
  EXPECT_EQ(out_of("{nearest: [1e200, 1e200, 0]}"), out_of("{vertices: [80]}"));
  EXPECT_EQ(out_of("{nearest: [-1e308, 1e308, 1e308]}"), out_of("{vertices: [72]}"));
  const Ending ending = moved("{sphere: {center: [1e200, 0, 0], radius: 2e200}}");
  EXPECT_THAT(ending.err, HasSubstr("fix"));  // all vertices, of which one is fixed
  EXPECT_EQ(ending.err.find("selects no vertex"), std::string::npos) << ending.err;
}

}  // namespace
}  // namespace deformlab::test
