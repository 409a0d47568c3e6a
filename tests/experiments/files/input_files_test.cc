#include <filesystem>

#include "tests/support/animations.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"

// No file that a run reads is replaced by what it writes, under whatever name.
namespace deformlab::test {
namespace {

namespace fs = std::filesystem;

class InputFiles : public Program {
 protected:
  InputFiles() {
    put("plane.off", plane_off());
    put("lift.yaml", kLift);
    put("bar.txt", "0 0\n100 0\n100 20\n0 20\n");
  }

  void expect_kept(const Words& words, const std::string& output, const std::string& input) const {
    expect_refused(words, {output + " would replace ", input, "choose another name"});
  }

  static Words shape(const Words& more) {
    Words words{"deform", "plane.off", "--edit", "lift.yaml", "--nodes", "20"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(InputFiles, StayWhateverTheyAreCalled) {
  fs::create_symlink("plane.off", place("symbolic.off"));
  fs::create_hard_link(place("plane.off"), place("hard.off"));
  fs::create_directory(place("folder"));
  fs::create_directory_symlink(".", place("here"));
  const Words names{"plane.off", "./plane.off",    "folder/../plane.off",      "symbolic.off",
                    "hard.off",  "here/plane.off", place("plane.off").string()};
  for (const std::string& name : names) {
    expect_kept(shape({"--out", name}), "--out '" + name + "'", "the input 'plane.off'");
  }
  expect_kept(shape({"--out", "out.off", "--metrics", "hard.off"}), "--metrics 'hard.off'",
              "the input 'plane.off'");
}

TEST_F(InputFiles, AreAllThatAnEditNames) {
  put("e/some.txt", "0\n");
  put("e/goals.off", "80, 1, 1, 0.2\n");
  put("e/edit.yaml",
      "edit:\n  - {select: {file: some.txt}, fix: true}\n  - {targets: goals.off}\n");
  put("graph.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
  const Words begin{"deform", "plane.off", "--edit", "e/edit.yaml", "--nodes", "20"};
  const auto with = [&](const Words& more) {
    Words words = begin;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  expect_kept(with({"--out", "e/goals.off"}), "--out 'e/goals.off'", "line 3 of e/edit.yaml");
  expect_kept(with({"--out", "out.off", "--metrics", "e/some.txt"}), "--metrics 'e/some.txt'",
              "line 2 of e/edit.yaml");
  expect_kept(with({"--out", "out.off", "--metrics", "e/edit.yaml"}), "--metrics 'e/edit.yaml'",
              "the edit 'e/edit.yaml'");
  expect_kept(with({"--out", "graph.obj", "graph.method=file", "graph.file=graph.obj"}),
              "--out 'graph.obj'", "override 'graph.file=graph.obj'");
  expect_success(with({"--out", "goals.off"}));  // the file beside the edit is another one
}

TEST_F(InputFiles, OfADrawingStay) {
  put("bar.yaml",
      "edit:\n  - {select: {point: [5, 10]}, fix: true}\n"
      "  - {select: {point: [95, 10]}, by: [0, 20]}\n");
  const Words begin{"deform", "bar.txt", "--edit", "bar.yaml", "--vertices", "60"};
  const auto with = [&](const Words& more) {
    Words words = begin;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  expect_success(with({"--out", "bar.png"}));
  Words again = with({"--out", "bar.png"});
  again[1] = "bar.png";
  expect_kept(again, "--out 'bar.png'", "the input 'bar.png'");
  expect_kept(with({"--out", "bar.png", "paint=[{mask: bar.png, weight: 9}]"}), "--out 'bar.png'",
              "override 'paint=[{mask: bar.png, weight: 9}]'");
  put("steps.intermediate.obj", "0\n");
  expect_kept(with({"--out", "steps.obj", "output.steps=true",
                    "edit.0.select={file: steps.intermediate.obj}"}),
              "output.steps 'steps.intermediate.obj'", "override 'edit.0.select");
}

TEST_F(InputFiles, OfAnAnimationStay) {
  for (int frame = 0; frame < 4; ++frame) {
    put("in-" + std::to_string(frame) + ".obj", tube_frame(frame));
  }
  put("tube.yaml", kTubeEdit);
  put("in.csv", particle_csv());
  put("stream.yaml", "edit:\n  - {select: {nearest: [9, 0, 0]}, by: [0, 0, 1]}\n");
  put("ring.yaml", std::string(kTubeEdit) + "  - {select: {file: out-3.obj}, fix: true}\n");
  fs::create_symlink("in-2.obj", place("out-2.obj"));
  const Words frames{"animate", "--frames", "in-%d.obj", "--edit",    "tube.yaml",
                     "--nodes", "20",       "--out",     "out-%d.obj"};
  expect_kept(frames, "--out 'out-2.obj'", "'in-2.obj'");
  fs::remove(place("out-2.obj"));
  put("out-3.obj", "1\n");
  Words ring = frames;
  ring[4] = "ring.yaml";
  expect_kept(ring, "--out 'out-3.obj'", "line 4 of ring.yaml");
  expect_kept({"animate", "--particles", "in.csv", "--edit", "stream.yaml", "--out", "./in.csv"},
              "--out './in.csv'", "the input 'in.csv'");
}

TEST_F(InputFiles, OfAConfigStay) {
  put("config.yaml", kExperiment);
  expect_success({"run", "config.yaml", "--out", "r"});
  expect_kept({"run", "r/config/config.yaml", "--out", "r"}, "the result 'r/config/config.yaml'",
              "the config 'r/config/config.yaml'");
  put("picture.yaml",
      "drawing: {file: r/config/picture.png}\n"
      "edit: [{select: {all: true}, by: [0, 1]}]\n");
  fs::create_directory_symlink("config", place("r/picture"));
  expect_kept({"run", "picture.yaml", "--out", "r"}, "the result 'r/picture/picture.png'",
              "line 1 of picture.yaml");
}

TEST_F(InputFiles, AndOutputsHaveNamesOfTheirOwn) {
  expect_kept(shape({"--out", "o.off", "--metrics", "m.png", "--picture", "./m.png"}),
              "--picture './m.png'", "--metrics 'm.png'");
}

}  // namespace
}  // namespace deformlab::test
