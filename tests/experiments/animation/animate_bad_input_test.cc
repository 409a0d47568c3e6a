#include "tests/support/animations.h"
#include "tests/support/program.h"

namespace deformlab::test {
namespace {

using File = std::pair<std::string, std::string>;

/// One thing that `animate` must refuse, and what it must say.
struct BadAnimation {
  std::string name;
  Words more;  ///< after the usual arguments, whose flags they replace
  Words words;
  std::vector<File> files = {};
};

void PrintTo(const BadAnimation& bad, std::ostream* out) { *out << bad.name; }

class RefusesFrames : public Program, public ::testing::WithParamInterface<BadAnimation> {};

TEST_P(RefusesFrames, WithAClearMessage) {
  for (int frame = 0; frame < 4; ++frame) {
    put("in-" + std::to_string(frame) + ".obj", tube_frame(frame));
  }
  put("edit.yaml", kTubeEdit);
  put("out-0.obj", "what was there before");
  for (const auto& [name, bytes] : GetParam().files) put(name, bytes);
  Words all{"animate", "--frames",   "in-%d.obj", "--edit", "edit.yaml",
            "--out",   "out-%d.obj", "--nodes",   "20"};
  all.insert(all.end(), GetParam().more.begin(), GetParam().more.end());
  expect_refused(all, GetParam().words);
}

BadAnimation bad_script(const std::string& name, const std::string& text, const Words& words) {
  return {name, {"--edit", "bad.yaml"}, words, {{"bad.yaml", text}}};
}

const std::string kKey = "keyframes:\n  - {frame: 1, edit: [{select: {vertices: [108]}, ";

INSTANTIATE_TEST_SUITE_P(
    Of, RefusesFrames,
    ::testing::Values(
        BadAnimation{"NoFrames", {"--frames", "no-%d.obj"}, {"no file matches", "no-%d.obj"}},
        BadAnimation{"NoFolder", {"--frames", "no/in-%d.obj"}, {"no file matches"}},
        BadAnimation{"AFrameIsMissing",
                     {},
                     {"frame 4 is missing", "'in-4.obj'", "'in-6.obj'"},
                     {{"in-6.obj", tube_frame(6)}}},
        BadAnimation{"AnotherNumberOfVertices",
                     {},
                     {"frame 2, 'in-2.obj', has 132 vertices, but frame 0 has 120"},
                     {{"in-2.obj", tube_frame(2, 11)}}},
        BadAnimation{"AFrameIsNoShape", {}, {"in-3.obj", "line"}, {{"in-3.obj", "v 1 2\n"}}},
        BadAnimation{"AFrameIsEmpty", {}, {"in-3.obj", "it is empty"}, {{"in-3.obj", ""}}},
        BadAnimation{"NoPattern", {"--frames", "in-0.obj"}, {"--frames", "needs one %d"}},
        BadAnimation{"AStrangePattern", {"--frames", "in-%s.obj"}, {"--frames", "needs one %d"}},
        BadAnimation{"APatternWithoutZero", {"--frames", "in-%3d.obj"}, {"needs one %d"}},
        BadAnimation{"TwoPatterns", {"--frames", "in-%d-%d.obj"}, {"needs one %d"}},
        BadAnimation{"APatternInAFolder", {"--frames", "%d/in.obj"}, {"needs one %d"}},
        BadAnimation{"NoPatternOut", {"--out", "out.obj"}, {"--out", "needs one %d"}},
        BadAnimation{"AnUnknownFormat", {"--out", "out-%d.abc"}, {"unknown extension '.abc'"}},
        BadAnimation{"NoFolderOut", {"--out", "no/out-%d.obj"}, {"there is no folder 'no'"}},
        BadAnimation{"TheInputItself", {"--out", "./in-%d.obj"}, {"would replace", "reads"}},
        BadAnimation{"AmongTheInput", {"--out", "in-1%d.obj"}, {"'in-10.obj'", "reads"}},
        BadAnimation{"BothKinds", {"--particles", "p.csv"}, {"frames or particles"}},
        BadAnimation{"NoEdit", {"--edit", ""}, {"animate needs"}},
        BadAnimation{"PictureIsNoPng", {"--picture", "p.jpg"}, {"p.jpg", ".png"}},
        BadAnimation{"PictureNotWritable",
                     {"--picture", "/proc/p.png"},
                     {"cannot write '/proc/p.png' (--picture)"}},
        BadAnimation{"PictureFolderMissing", {"--picture", "no/p.png"}, {"no folder 'no'"}},
        BadAnimation{"MetricsNotWritable",
                     {"--metrics", "/proc/m.json"},
                     {"cannot write '/proc/m.json' (--metrics)"}},
        BadAnimation{"MetricsAreAFrame",
                     {"--metrics", "./in-2.obj"},
                     {"--metrics './in-2.obj'", "a frame of --frames 'in-%d.obj'"}},
        BadAnimation{"MetricsAreAFrameToBe",
                     {"--metrics", "out-3.obj"},
                     {"--metrics 'out-3.obj'", "a frame of --out 'out-%d.obj'"}},
        BadAnimation{
            "MetricsAreTheEdit", {"--metrics", "edit.yaml"}, {"edit.yaml", "would replace"}},
        BadAnimation{"MetricsAreThePicture",
                     {"--metrics", "p.png", "--picture", "p.png"},
                     {"p.png", "would replace"}},
        BadAnimation{"MetricsAreTheProgress",
                     {"--metrics", "out-%d.obj.progress"},
                     {"out-%d.obj.progress", "would replace"}},
        BadAnimation{"TheEditIsAFrameToBe",
                     {"--edit", "out-2.obj"},
                     {"--edit 'out-2.obj'", "a frame of --out"},
                     {{"out-2.obj", kTubeEdit}}},
        BadAnimation{
            "NothingPictured", {"--picture", "p.png", "pictured=0"}, {"pictured is 0", "1 to 64"}},
        BadAnimation{"ATinyPicture",
                     {"--picture", "p.png", "picture.width=0"},
                     {"picture.width", "picture.width is 0"}},
        BadAnimation{"NoDirection",
                     {"--picture", "p.png", "picture.direction=[0, 0, 0]"},
                     {"direction", "zero"}},
        BadAnimation{"AnotherMethod", {"deformer=rbf"}, {"deformer is rbf", "takes no animation"}},
        BadAnimation{"AParticlesPath", {"path=3"}, {"'path' is the id of a particle"}},
        BadAnimation{"TooManyNodes", {"--nodes", "200", "graph.fit=false"}, {"200", "120"}},
        BadAnimation{"ANodeBesideTheShape",
                     {"graph.method=file", "graph.file=graph.obj"},
                     {"node 1 of the graph is", "sit on vertices"},
                     {{"graph.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"}}},
        BadAnimation{"NoEditFile", {"--edit", "none.yaml"}, {"none.yaml"}},
        bad_script("Nothing", "pose: 1\n", {"neither 'edit' nor 'keyframes'"}),
        bad_script("AnUnknownKey", "keyframe: []\n", {"unknown key 'keyframe'", "'keyframes'"}),
        bad_script("NoFrameOfAKeyframe", "keyframes:\n  - edit: []\n", {"missing key 'frame'"}),
        bad_script("NoEditOfAKeyframe", "keyframes:\n  - frame: 1\n", {"missing key 'edit'"}),
        bad_script("GarbageAsAFrame", "keyframes:\n  - {frame: x, edit: []}\n", {"frame", "'x'"}),
        bad_script("AKeyframeOutside",
                   "keyframes:\n  - {frame: 9, edit: [{select: {all: true}, fix: true}]}\n",
                   {"keyframe 1", "names frame 9", "0 to 3"}),
        bad_script("APoseOutside", "pose: -1\n" + kKey + "by: [0, 0, 1]}]}\n",
                   {"'pose'", "names frame -1"}),
        bad_script("TwoKeyframesOfOneFrame",
                   kKey + "by: [0, 0, 1]}]}\n" + kKey.substr(kKey.find('\n') + 1) +
                       "by: [0, 1, 0]}]}\n",
                   {"keyframe 1", "keyframe 2", "are both of frame 1"}),
        bad_script("AlwaysAndInAKeyframe", std::string(kTubeEdit) + kKey + "by: [0, 0, 1]}]}\n",
                   {"vertex 108", "all frames", "keyframe 1"}),
        bad_script("FixedAndMoved",
                   "edit:\n  - {select: {vertices: [108]}, fix: true}\n" + kKey +
                       "by: [0, 0, 1]}]}\n",
                   {"vertex 108 is fixed by edit", "moved by keyframe 1"}),
        bad_script("MovedAndFixed",
                   "edit:\n  - {select: {vertices: [108]}, by: [0, 0, 1]}\n" + kKey +
                       "fix: true}]}\n",
                   {"vertex 108 is fixed by keyframe 1", "moved by edit"}),
        bad_script("APlace", "edit:\n  - {select: {point: [0, 0, 0]}, by: [0, 0, 1]}\n",
                   {"not a vertex", "does not follow"}),
        bad_script("NoSuchVertex", "edit:\n  - {select: {vertices: [120]}, by: [0, 0, 1]}\n",
                   {"vertex 120 does not exist"})),
    [](const auto& test) { return test.param.name; });

class RefusesParticles : public Program, public ::testing::WithParamInterface<BadAnimation> {};

TEST_P(RefusesParticles, WithAClearMessage) {
  put("in.csv", particle_csv());
  put("edit.yaml", "edit:\n  - {select: {vertices: [0]}, by: [0, 0, 1]}\n");
  put("out.csv", "what was there before");
  for (const auto& [name, bytes] : GetParam().files) put(name, bytes);
  Words all{"animate", "--particles", "in.csv",  "--edit", "edit.yaml",
            "--out",   "out.csv",     "--nodes", "12"};
  all.insert(all.end(), GetParam().more.begin(), GetParam().more.end());
  expect_refused(all, GetParam().words);
}

BadAnimation bad_csv(const std::string& name, const std::string& text, const Words& words) {
  return {name, {}, words, {{"in.csv", text}}};
}

const std::string kHead = "frame,id,x,y,z\n0,1,0,0,0\n1,1,1,0,0\n";

INSTANTIATE_TEST_SUITE_P(
    Of, RefusesParticles,
    ::testing::Values(
        BadAnimation{"NoFile", {"--particles", "no.csv"}, {"no.csv"}},
        BadAnimation{"AFolder", {"--particles", "."}, {"cannot read"}},
        BadAnimation{"AParticleWithoutFrames", {"path=99"}, {"particle 99", "has no frame"}},
        BadAnimation{"TheInputAsTheEdit", {"--edit", "in.csv"}, {"in.csv"}},
        BadAnimation{
            "TheEditAsTheOutput", {"--out", "edit.yaml"}, {"would replace the edit 'edit.yaml'"}},
        BadAnimation{"MetricsAreTheInput", {"--metrics", "in.csv"}, {"in.csv", "would replace"}},
        BadAnimation{
            "MetricsAreTheOutput", {"--metrics", "./out.csv"}, {"out.csv", "would replace"}},
        BadAnimation{
            "MetricsNotWritable", {"--metrics", "/proc/m.json"}, {"cannot write '/proc/m.json'"}},
        BadAnimation{"PictureIsNoPng", {"--picture", "p"}, {"'p'", ".png"}},
        BadAnimation{"PictureIsAFolder", {"--picture", "f.png"}, {"folder"}, {{"f.png/x", ""}}},
        BadAnimation{"NoNodes", {"--nodes", "0"}, {"graph.nodes is 0"}},
        BadAnimation{"AGraphOfMeshes", {"graph.method=simplification"}, {"graph.method"}},
        BadAnimation{"APose",
                     {},
                     {"'pose' is for meshes"},
                     {{"edit.yaml", "pose: 0\nedit: [{select: {all: true}, fix: true}]\n"}}},
        bad_csv("Empty", "", {"line 1", "'frame' is missing"}),
        bad_csv("OnlyAHeader", "frame,id,x,y,z\n", {"has no particles"}),
        bad_csv("NoHeader", "0,1,0,0,0\n", {"line 1", "'frame' is missing"}),
        bad_csv("AMissingColumn", "frame,id,x,y\n0,1,0,0\n", {"line 1", "'z' is missing"}),
        bad_csv("AMissingField", kHead + "2,1,2,0\n", {"line 4", "4 fields", "5"}),
        bad_csv("OneFieldTooMany", kHead + "2,1,2,0,0,0\n", {"line 4", "6 fields"}),
        bad_csv("AGarbageCoordinate", kHead + "\n2,1,2,zero,0\n", {"line 5", "y is 'zero'"}),
        bad_csv("Infinite", kHead + "2,1,2,0,inf\n", {"line 4", "z is 'inf'"}),
        bad_csv("NoPositions", "frame,id,x,y,z\n0,1,0,0,nan\n", {"no particle with a position"}),
        bad_csv("TooLarge", kHead + "2,1,2,0,1e300\n", {"line 4", "z is '1e300'"}),
        bad_csv("AGarbageFrame", kHead + "2.5,1,2,0,0\n", {"line 4", "frame is '2.5'"}),
        bad_csv("AGarbageId", kHead + "2,one,2,0,0\n", {"line 4", "id is 'one'"}),
        bad_csv("TwiceInOneFrame", kHead + "2,1,2,0,0\n2,3,1,1,1\n2,1,2,0,1\n",
                {"particle 1 is twice in frame 2", "lines 4 and 6"}),
        bad_csv("TwiceInOneFrameOutOfOrder", kHead + "0,3,2,0,0\n0,1,2,0,1\n",
                {"particle 1 is twice in frame 0", "lines 2 and 5"}),
        bad_csv("NothingMoves", "frame,id,x,y,z\n0,1,0,0,0\n1,1,0,0,0\n", {"does not move"}),
        bad_csv("OneFrame", "frame,id,x,y,z\n0,1,0,0,0\n0,2,1,0,0\n", {"does not move"})),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace deformlab::test
