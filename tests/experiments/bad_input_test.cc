#include "tests/support/program.h"
#include "tests/support/scenes.h"

namespace deformlab::test {
namespace {

using File = std::pair<std::string, std::string>;

/// One thing that the program must refuse, and what it must say.
struct Refusal {
  std::string name;
  Words arguments;
  Words words;
  std::vector<File> files = {};
};

void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }

class Refuses : public Program, public ::testing::WithParamInterface<Refusal> {};

TEST_F(Program, RefusesALinkToItself) {
  put("lift.yaml", kLift);
  std::filesystem::create_symlink("loop.off", place("loop.off"));
  const Ending ending =
      start({"deform", "loop.off", "--edit", "lift.yaml", "--out", "out.off", "--nodes", "9"});
  EXPECT_EQ(ending.status, 2);
  EXPECT_THAT(ending.err, ::testing::HasSubstr("cannot read 'loop.off'"));
}

TEST_P(Refuses, WithAClearMessage) {
  put("plane.off", plane_off());
  put("lift.yaml", kLift);
  put("c.yaml", kExperiment);
  put("out.off", "what was there before");
  put("results/c/metrics.json", "an older result");
  put("results/c/manifest.txt",
      "deformlab has written these files. Its next run into this folder replaces them, and leaves "
      "all others.\nmetrics.json\n");
  for (const auto& [name, bytes] : GetParam().files) put(name, bytes);
  expect_refused(GetParam().arguments, GetParam().words);
}

Words deform(const std::string& shape, const Words& more = {}, const std::string& edit = "lift") {
  Words all{"deform", shape, "--edit", edit + ".yaml", "--out", "out.off", "--nodes", "10"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Refusal bad_shape(const std::string& name, const std::string& file, const std::string& bytes,
                  Words words) {
  words.push_back("'" + file + "'");
  return {name, deform(file), words, {{file, bytes}}};
}

Refusal bad_edit(const std::string& name, const std::string& text, const Words& words) {
  return {name, deform("plane.off", {}, "bad"), words, {{"bad.yaml", text}}};
}

Refusal bad_option(const std::string& name, const std::string& option, const Words& words) {
  return {name, deform("plane.off", {option}), words};
}

Refusal bad_config(const std::string& name, const std::string& option, const Words& words) {
  return {name, {"run", "c.yaml", option}, words};
}

Refusal bad_config_file(const std::string& name, const std::string& text, const Words& words) {
  return {name, {"run", "bad.yaml"}, words, {{"bad.yaml", text}}};
}

std::string with_vertex(const std::string& third) {
  return "OFF\n4 1 0\n0 0 0\n1 0 0\n" + third + "\n0 1 0\n4 0 1 2 3\n";
}

const Refusal kShapes[] = {
    {"Missing", deform("nope.off"), {"cannot read 'nope.off'", "no such file"}},
    {"Folder", deform("results"), {"results"}},
    bad_shape("EmptyOff", "s.off", "", {"cannot read"}),
    bad_shape("EmptyObj", "s.obj", "", {"cannot read"}),
    bad_shape("EmptyPly", "s.ply", "", {"cannot read"}),
    bad_shape("EmptyStl", "s.stl", "", {"cannot read"}),
    bad_shape("EmptyXyz", "s.xyz", "", {"cannot read", "empty"}),
    bad_shape("TruncatedOff", "s.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", {"cannot read"}),
    bad_shape("TruncatedObj", "s.obj", "v 0 0 0\nv 1 0 0\nv 1 1", {"vertex 2", "line 3"}),
    bad_shape("TruncatedPly", "s.ply",
              "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
              "property float z\nend_header\n0 0 0\n",
              {"cannot read"}),
    bad_shape("TruncatedStl", "s.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
              {"cannot read"}),
    bad_shape("TruncatedXyz", "s.xyz", "0 0 0\n1 0\n", {"line 2"}),
    bad_shape("FaceBeyondVertices", "s.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", {"7"}),
    bad_shape("NaN", "s.off", with_vertex("nan 1 0"), {"vertex 2", "nan"}),
    bad_shape("Infinite", "s.off", with_vertex("1 inf 0"), {"vertex 2", "inf"}),
    bad_shape("BeyondDoubles", "s.off", with_vertex("1e400 1 0"), {"vertex 2", "1e400"}),
    bad_shape("NotANumber", "s.off", with_vertex("one 1 0"), {"line 5", "one"}),
    bad_shape("NoVertices", "s.off", "OFF\n0 0 0\n", {"no vertices"}),
    bad_shape("UnknownExtension", "s.foo", "1 2 3",
              {"shapes are read from .off, .obj, .ply, .stl and .xyz"}),
    bad_shape("HugeLengths", "s.off", plane_off(9, 1e99), {"e+99", "scale"}),
    bad_shape("FarTooHugeLengths", "s.off", plane_off(9, 1e300), {"e+300", "scale"}),
    bad_shape("TinyLengths", "s.xyz", "0 0 0\n1e-300 0 0\n", {"1e-300", "scale"}),
};

const Refusal kEdits[] = {
    {"Missing", deform("plane.off", {}, "nope"), {"cannot read 'nope.yaml'", "no such file"}},
    bad_edit("Empty", "", {"'bad.yaml' is empty"}),
    bad_edit("List", "- 1\n- 2\n", {"map of keys", "line 1 of bad.yaml"}),
    bad_edit("NoEntries", "edit: []\n", {"no entries", "line 1 of bad.yaml"}),
    bad_edit("WrongTopKey", "edits: []\n", {"unknown key 'edits'", "did you mean 'edit'?"}),
    bad_edit("NotYaml", "edit: [\n", {"not valid YAML", "bad.yaml"}),
    bad_edit("IndexTooLarge", "edit:\n  - {select: {vertices: [81]}, fix: true}\n",
             {"vertex 81", "81 vertices", "line 2 of bad.yaml"}),
    bad_edit("IndexNegative", "edit:\n  - {select: {vertices: [-1]}, fix: true}\n", {"vertex -1"}),
    bad_edit("NothingSelected",
             "edit:\n  - {select: {sphere: {center: [9, 9, 9], radius: 1}}, fix: true}\n",
             {"selects no vertex", "line 2 of bad.yaml", "from [0, 0, 0] to [1, 1, 0]"}),
    bad_edit("FixedAndMoved",
             "edit:\n  - {select: {vertices: [3, 4]}, fix: true}\n"
             "  - {select: {vertices: [4]}, by: [0, 0, 1]}\n",
             {"vertex 4", "fixed", "moved", "line 2", "line 3"}),
    bad_edit("MovedTwice",
             "edit:\n  - {select: {vertices: [4]}, by: [0, 0, 2]}\n"
             "  - {select: {vertices: [4]}, by: [0, 0, 1]}\n",
             {"vertex 4", "line 2", "line 3", "keep one"}),
    bad_edit("UnknownKey", "edit:\n  - {select: {vertices: [4]}, fixx: true}\n",
             {"unknown key 'fixx'", "line 2 of bad.yaml", "did you mean 'fix'?"}),
    bad_edit("DuplicateKey", "edit:\n  - select: {vertices: [4]}\n    fix: true\n    fix: true\n",
             {"duplicate key 'fix'", "line 3", "line 4"}),
    bad_edit("WrongType", "edit:\n  - {select: {vertices: [a]}, fix: true}\n",
             {"whole number", "'a'", "line 2 of bad.yaml"}),
    bad_edit("TwoSelectors",
             "edit:\n  - {select: {vertices: [4], nearest: [0, 0, 0]}, fix: true}\n",
             {"exactly one", "line 2"}),
    bad_edit("NoAction", "edit:\n  - {select: {vertices: [4]}}\n",
             {"fix, to, matrix, targets, or any of scale, rotate and by"}),
    bad_edit("NoAxis", "edit:\n  - {select: {all: true}, rotate: {axis: [0, 0, 0], degrees: 9}}\n",
             {"axis", "line 2"}),
    bad_edit("NumberBeyondDoubles", "edit:\n  - {select: {all: true}, by: [0, 0, 1e400]}\n",
             {"finite number", "1e400"}),
    bad_edit("FarTarget", "edit:\n  - {select: {vertices: [4]}, to: [1e300, 0, 0]}\n",
             {"1e+300", "vertex 4"}),
    bad_edit("AllFixed",
             "edit:\n  - {select: {all: true}, fix: true}\n"
             "  - {select: {point: [0.5, 0.5, 0]}, by: [0, 0, 1]}\n",
             {"fixes all 81 vertices"}),
    bad_edit("FarPoint", "edit:\n  - {select: {point: [50, 0, 0]}, by: [0, 0, 1]}\n",
             {"edit entry 1 (line 2 of bad.yaml)", "[50, 0, 0]", "49 away", "the unit"}),
    bad_edit("NoFileOfIndices", "edit:\n  - {select: {file: nope.txt}, fix: true}\n",
             {"nope.txt", "line 2"}),
    bad_edit("FileOfWords", "edit:\n  - {select: {file: lift.yaml}, fix: true}\n",
             {"vertex index", "line 1 of lift.yaml"}),
};

// A graph made by hand.
Refusal bad_graph(const std::string& name, const std::string& text, const Words& words) {
  return {name,
          deform("plane.off", {"graph.method=file", "graph.file=g.obj"}),
          words,
          {{"g.obj", text}}};
}

std::string vertices_without(int count, int left_out) {
  std::string list;
  for (int i = 0; i < count; ++i) {
    if (i != left_out) list += (list.empty() ? "" : ", ") + std::to_string(i);
  }
  return "{vertices: [" + list + "]}";
}

const char* const kLiftOne =
    "edit:\n  - {select: {vertices: [0, 1]}, fix: true}\n"
    "  - {select: {vertices: [40]}, by: [0, 0, 1]}\n";

const Refusal kGraphs[] = {
    bad_graph("AnIsolatedNode", "v 0 0 0\nv 1 0 0\nv 0.5 1 0\nl 1 2\n",
              {"'g.obj': node 3 (line 3) is isolated", "join it to another, or leave it out"}),
    bad_graph("ARepeatedNode", "v 0 0 0\nv 1 0 0\nv 1 0 0\nl 1 2 3\n",
              {"'g.obj': node 3 (line 3) is repeated", "node 2 (line 2)", "leave one out"}),
    bad_graph("AnEdgeToNowhere", "v 0 0 0\nv 1 0 0\nl 1 3\n",
              {"'g.obj': line 3: the edge from node 1 to node 3 leads nowhere", "2 nodes"}),
    bad_graph("AnEdgeBackwardsToNowhere", "v 0 0 0\nv 1 0 0\nl 1 -5\n",
              {"line 3: an edge to '-5' leads nowhere", "2 nodes"}),
    bad_graph("AnEdgeToItself", "v 0 0 0\nv 1 0 0\nl 1 2\nl 1 1\n",
              {"line 4: the edge joins node 1 to itself"}),
    bad_graph("ARepeatedEdge", "v 0 0 0\nv 1 0 0\nl 1 2\nl 2 1\n",
              {"line 4: the edge between node 1 and node 2 is repeated", "line 3"}),
    bad_graph("NoNodeAtAll", "# nothing yet\n", {"it has no node", "'v x y z'"}),
    bad_option("NoFileOfAGraph", "graph={method: file, nodes: 9}",
               {"graph.method is file", "give it an OBJ"}),
    bad_option("NoSuchFileOfAGraph", "graph={method: file, file: nope.obj}",
               {"cannot read 'nope.obj'", "no such file"}),
    bad_option("AFolderAsAGraph", "graph={method: file, file: results}",
               {"cannot read 'results'", "it is a folder"}),
    bad_option("AFileOfAnotherMethod", "graph.file=plane.off",
               {"graph.file is 'plane.off'", "method is sampling", "make it file"}),
    bad_option("SimplifiedTooFar", "graph={method: simplification, nodes: 1}",
               {"graph.nodes is 1 ", "but simplification ends at 3", "an aspect ratio above 3",
                "use 3 nodes, a greater aspect_ratio, or method: sampling"}),
    bad_option("SimplifiedTooFarForItsTriangles",
               "graph={method: simplification, nodes: 20, aspect_ratio: 1}",
               {"graph.nodes is 20 ", "but simplification ends at ", "aspect ratio above 1,"}),
    bad_option("SimplifiedToMore", "graph={method: simplification, nodes: 82, fit: false}",
               {"graph.nodes is 82", "1 to 81"}),
    {"ACutAroundOneHandle",
     deform("plane.off",
            {"cut=[{between: {vertices: [40]}, and: " + vertices_without(81, 40) + "}]"}, "one"),
     {"cut 1", "vertex 40 would have no node to follow", "all 10 nodes are on the other side",
      "use more nodes, or cut off less"},
     {{"one.yaml", kLiftOne}}},
    {"ACutAroundAllHandles",
     deform("plane.off", {"--nodes=1",
                          "cut=[{between: {box: {min: [0.99, -1, -1], max: [2, 2, 1]}}, "
                          "and: {box: {min: [-1, -1, -1], max: [0.98, 2, 1]}}}]"}),
     {"cut 1", "9 vertices, the first of them vertex 8, would have no node to follow",
      "the one node is on the other side"}},
    bad_option("ACutOfOneSide", "cut=[{between: {vertices: [40]}, and: {all: true}}]",
               {"cut 1", "vertex 40 is on both sides", "take it out of one"}),
};

const Refusal kOptions[] = {
    bad_option("NoNodes", "graph.nodes=0", {"graph.nodes is 0", "1 to 100000"}),
    bad_option("NegativeNodes", "--nodes=-1", {"graph.nodes is -1", "1 to 100000"}),
    bad_option("FarTooManyNodes", "--nodes=2147483647",
               {"graph.nodes is 2147483647", "1 to 100000"}),
    bad_option("NodesBeyondInt", "--nodes=99999999999", {"--nodes", "99999999999"}),
    bad_option("NodesInWords", "--nodes=ten", {"--nodes", "ten"}),
    bad_option("MisspeltFlag", "--ndoes=3", {"--ndoes", "did you mean 'nodes'?"}),
    bad_option("FlagWithoutValue", "--picture", {"--picture", "value"}),
    {"MoreNodesThanPoints",
     deform("p.xyz", {"graph.fit=false"}),
     {"graph.nodes is 10", "4 distinct points"},
     {{"p.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 1\n"}}},
    {"AllPointsInOnePlace",
     deform("p.xyz", {"graph.fit=false"}, "one"),
     {"graph.nodes is 10", "1 distinct point "},
     {{"p.xyz", "1 2 3\n1 2 3\n1 2 3\n"},
      {"one.yaml", "edit:\n  - {select: {vertices: [0]}, by: [0, 0, 1]}\n"}}},
    bad_option("NoNeighbors", "graph.neighbors=0", {"graph.neighbors is 0", "1 to 16"}),
    bad_option("TooManyNeighbors", "graph.neighbors=17", {"graph.neighbors is 17", "1 to 16"}),
    bad_option("NoEpsilon", "solver.epsilon=0",
               {"solver.epsilon is 0", "greater than 0 and less than 1"}),
    bad_option("NaNEpsilon", "solver.epsilon=nan", {"finite number", "nan"}),
    bad_option("NoIterations", "solver.max_iterations=0", {"max_iterations is 0", "at least 1"}),
    bad_option("NegativeWeight", "energies.rotation=-1",
               {"energies.rotation is -1 (override 'energies.rotation=-1')", "at least 0"}),
    bad_option("UnknownEnergy", "energies.rotatoin=2",
               {"unknown energy 'rotatoin'", "did you mean 'rotation'?"}),
    bad_option("UnknownLoss", "losses.constraint.kind=hubre",
               {"unknown value 'hubre' for 'losses.constraint.kind'", "none, huber, cauchy, tukey",
                "did you mean 'huber'?"}),
    bad_option("LossOfAnUnknownEnergy", "losses.constrant.kind=huber",
               {"unknown energy 'constrant'", "did you mean 'constraint'?"}),
    bad_option("LossWithoutAKind", "losses.constraint=huber",
               {"'losses.constraint'", "expected a map of keys", "'huber'"}),
    bad_option("UnknownKeyOfALoss", "losses.constraint.scael=1",
               {"unknown key 'scael'", "did you mean 'scale'?"}),
    bad_option("NoLossScale", "losses.constraint={kind: huber, scale: 0}",
               {"losses.constraint.scale is 0", "1e-06 to 1000"}),
    bad_option("NegativeLossScale", "losses.constraint={kind: cauchy, scale: -1}",
               {"losses.constraint.scale is -1", "1e-06 to 1000"}),
    bad_option("NoLengthUnit", "length_unit=0", {"length_unit is '0'", "positive"}),
    bad_option("NonsenseLengthUnit", "length_unit=furlong", {"'furlong'", "mean_edge"}),
    bad_option("NaNLengthUnit", "length_unit=nan", {"'nan'", "mean_edge"}),
    bad_option("TinyLengthUnit", "length_unit=1e-300", {"'1e-300'", "mean edge"}),
    bad_option("UnknownMethod", "solver.method=cers", {"'cers'", "did you mean 'ceres'?"}),
    bad_option("UnknownLinearSolver", "solver.linear_solver=cholmud",
               {"'cholmud'", "did you mean 'cholmod'?"}),
    bad_option("LinearSolverOfCeres", "solver.linear_solver=dense_qr",
               {"'dense_qr'", "gauss_newton", "cholmod"}),
    bad_option("OldLinearSolver", "solver.linear_solver=separable_cg",
               {"'separable_cg'", "it is called 'kronecker_cg' now"}),
    bad_option("OldDeformer", "deformer=arap", {"'arap'", "it is called 'cgal_arap' now"}),
    bad_option("OldOptionsOfADeformer", "arap.iterations=3",
               {"unknown key 'arap'", "it is called 'cgal_arap' now"}),
    bad_option("OldNameOfArap2d", "deformer=rigid_shape", {"it is called 'arap_2d' now"}),
    bad_option("OldPlaceOfAKey", "graph.adaptive.start=3",
               {"'graph.adaptive' is called 'adaptive' now"}),
    bad_option("UnknownKey", "graph.nods=3", {"unknown key 'nods'", "did you mean 'nodes'?"}),
    bad_option("KeyOfConfigs", "shape.columns=3", {"unknown key 'shape'"}),
    bad_option("NotAnOverride", "graph", {"'graph'", "key=value"}),
    bad_option("WrongType", "graph=3", {"'graph'", "a map of keys"}),
};

const Refusal kOutputs[] = {
    {"UnknownCommand", {"defrom"}, {"unknown command 'defrom'", "did you mean 'deform'?"}},
    {"NoCommand", {"--nodes=3"}, {"no command", "run, deform, animate, list, help"}},
    {"NothingToDeform", {"deform"}, {"--edit EDIT.yaml --out OUT"}},
    {"NothingToRun", {"run"}, {"run which config?"}},
    bad_option("FolderMissing", "--out=nope/o.off", {"'nope/o.off'", "no folder 'nope'"}),
    bad_option("BelowAFile", "--out=plane.off/o.off", {"no folder 'plane.off'"}),
    bad_option("NotWritable", "--out=/proc/o.off", {"cannot write '/proc/o.off'"}),
    bad_option("OutIsAFolder", "--out=results", {"results"}),
    bad_option("OutFormatUnknown", "--out=o.foo", {"'o.foo'", "known: .off"}),
    bad_option("MetricsNotWritable", "--metrics=/proc/m.json", {"cannot write '/proc/m.json'"}),
    bad_option("MetricsFolderMissing", "--metrics=nope/m.json", {"no folder 'nope'"}),
    bad_option("MetricsIsAFolder", "--metrics=results", {"results", "folder"}),
    bad_option("MetricsOverTheShape", "--metrics=out.off", {"--metrics", "--out", "out.off"}),
    bad_option("PictureNotWritable", "--picture=/proc/p.png", {"cannot write '/proc/p.png'"}),
    {"PictureOfNoSize",
     deform("plane.off", {"picture.width=0", "--picture=p.png"}),
     {"picture.width is 0", "1 to 4096"}},
    bad_option("PictureIsNoPng", "--picture=p.jpg", {"p.jpg", ".png"}),
    {"ResultsBelowAFile", {"run", "c.yaml", "--out", "plane.off/r"}, {"plane.off/r"}},
    {"ResultsNotWritable", {"run", "c.yaml", "--out", "/proc/r"}, {"/proc/r"}},
    {"ResultInTheWay", {"run", "c.yaml", "--out", "o"}, {"o/c"}, {{"o/c", "a file"}}},
};

const Refusal kConfigs[] = {
    {"Missing", {"run", "nope.yaml", "--out", "new"}, {"cannot read 'nope.yaml'", "no such file"}},
    {"Folder", {"run", "results"}, {"cannot read 'results'", "folder"}},
    {"SecondMissing", {"run", "c.yaml", "nope.yaml"}, {"cannot read 'nope.yaml'"}},
    {"SameName",
     {"run", "c.yaml", "a/c.yaml"},
     {"c.yaml", "a/c.yaml"},
     {{"a/c.yaml", kExperiment}}},
    bad_config_file("Empty", "", {"'bad.yaml' is empty"}),
    bad_config_file("Image", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16), {"bad.yaml"}),
    bad_config_file("Brackets", std::string(10 << 20, '['), {"deeper", "bad.yaml"}),
    bad_config_file("DuplicateKey", kExperiment + "title: twice\n",
                    {"duplicate key 'title'", "line 1 and line"}),
    bad_config_file("UnknownKey", kExperiment + "graph.nods: 3\n", {"unknown key", "bad.yaml"}),
    bad_config_file("NoEdit", "title: t\n", {"missing key 'edit'"}),
    bad_config("WrongType", "graph.nodes=1.5", {"'graph.nodes'", "whole number", "'1.5'"}),
    bad_config("NoSuchShape", "shape.file=nope.off", {"'nope.off'"}),
    bad_config("NoColumns", "shape.columns=1", {"shape.columns is 1", "2 to 4000"}),
    bad_config("NoWidth", "shape.width=0", {"shape.width"}),
    bad_config("HugePlane", "shape.depth=1e308", {"1e+308", "scale"}),
    bad_config("HugeBumps", "shape={columns: 9, rows: 9, bumps: 1, bump_height: 1e308}",
               {"e+308", "scale"}),
    bad_config("NoPicture", "picture.width=0", {"picture.width is 0", "1 to 4096"}),
    bad_config("HugePicture", "picture.width=100000", {"picture.width is 100000", "1 to 4096"}),
    bad_config("NoDirection", "picture.direction=[0, 0, 0]", {"direction", "zero"}),
    bad_config("UpAlongTheView", "picture={direction: [1, 1, 0], up: [-1, -1, 0]}", {"parallel"}),
    bad_config("SweepOverABadKey", "sweep={graph.nods: [3]}", {"'nods'", "did you mean 'nodes'?"}),
    bad_config("SweepOverABadValue", "sweep={graph.nodes: [9, 0]}", {"graph.nodes is 0"}),
    bad_config("SweepOfNothing", "sweep={graph.nodes: []}", {"one value or more"}),
    bad_config("SweepOverClaims", "sweep={claims: [[]]}", {"'claims'", "sweep"}),
    bad_config("UnknownMeasure", "claims=[{name: a, measure: cots, at_most: 1}]",
               {"claim 'a'", "'cots'", "did you mean 'cost'?"}),
    bad_config("ReferenceThatIsNoMap", "measure.reference=[]", {"'measure.reference'", "map"}),
    bad_config("ReferenceToNoRun", "measure.reference={graph.nodes: 7}",
               {"measure.reference", "0 of 1 runs"}),
    bad_config("ExpectsNothing", "claims=[{name: a, measure: cost}]",
               {"claim 'a'", "at_least, at_most or equals"}),
    bad_config("ClaimOfNoRun", "claims=[{name: a, measure: cost, at_most: 1, where: {x: 7}}]",
               {"claim 'a'", "no run has {x: 7}"}),
    bad_config("ClaimWithinLessThanNothing",
               "claims=[{name: a, measure: cost, equals: 1, within: -1}]",
               {"claims[0].within is -1", "at least 0"}),
    bad_config("ClaimWhereNoMap", "claims=[{name: a, measure: cost, equals: 1, where: 3}]",
               {"claim 'a'", "'where'", "'3'"}),
    bad_config("LongOverride", "title.x=" + std::string(5000, 'y'), {"title"}),
    bad_config("MisspeltClaim", "claims=[{nmae: a, measure: cost}]",
               {"'nmae'", "did you mean 'name'?"}),
};

std::string name_of(const ::testing::TestParamInfo<Refusal>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Shape, Refuses, ::testing::ValuesIn(kShapes), name_of);
INSTANTIATE_TEST_SUITE_P(Edit, Refuses, ::testing::ValuesIn(kEdits), name_of);
INSTANTIATE_TEST_SUITE_P(Graph, Refuses, ::testing::ValuesIn(kGraphs), name_of);
INSTANTIATE_TEST_SUITE_P(Option, Refuses, ::testing::ValuesIn(kOptions), name_of);
INSTANTIATE_TEST_SUITE_P(Output, Refuses, ::testing::ValuesIn(kOutputs), name_of);
INSTANTIATE_TEST_SUITE_P(Config, Refuses, ::testing::ValuesIn(kConfigs), name_of);

}  // namespace
}  // namespace deformlab::test
