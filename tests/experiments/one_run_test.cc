#include <nlohmann/json.hpp>

#include "geometry/shape/shape_io.h"
#include "tests/support/animations.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"
#include "tests/support/shapes.h"

// The commands `deform` and `animate` know the keys that a config knows, and `run` knows files of
// animations.
namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

using Json = nlohmann::json;

int width_of(const std::string& png) {
  int width = 0;
  for (int i = 16; i < 20; ++i) width = 256 * width + static_cast<unsigned char>(png.at(i));
  return width;
}

class OneRun : public Program {
 protected:
  OneRun() {
    put("plane.off", plane_off());
    put("bar.txt", "0 0\n100 0\n100 20\n0 20\n");
    for (int frame = 0; frame < 4; ++frame) {
      put("in-" + std::to_string(frame) + ".obj", tube_frame(frame));
    }
    put("in.csv", particle_csv());
    put("lift.yaml", kLift);
    put("bar.yaml",
        "edit:\n  - {select: {point: [5, 10]}, fix: true}\n"
        "  - {select: {point: [95, 10]}, by: [0, 20]}\n");
    put("tube.yaml", kTubeEdit);
    put("stream.yaml",
        "edit:\n  - {select: {vertices: [0, 1]}, by: [0, 0, 0]}\n"
        "  - {select: {nearest: [9, 0, 0]}, by: [0, 0, 1]}\n");
  }

  Words shape(const Words& more) const {
    return with({"deform", "plane.off", "--edit", "lift.yaml", "--out", "out.off", "--nodes", "20"},
                more);
  }
  Words drawing(const Words& more) const {
    return with({"deform", "bar.txt", "--edit", "bar.yaml", "--out", "out.png", "--vertices", "60"},
                more);
  }
  Words frames(const Words& more) const {
    return with({"animate", "--frames", "in-%d.obj", "--edit", "tube.yaml", "--out", "out-%d.obj",
                 "--nodes", "20"},
                more);
  }
  Words particles(const Words& more) const {
    return with({"animate", "--particles", "in.csv", "--edit", "stream.yaml", "--out", "out.csv",
                 "--nodes", "12"},
                more);
  }
  Json measured(Words words) const {
    words.insert(words.end(), {"--metrics", "m.json"});
    expect_success(words);
    return Json::parse(get("m.json"));
  }
  int pictured(Words words) const {
    words.insert(words.end(), {"--picture", "p.png", "picture.height=30"});
    expect_success(words);
    return width_of(get("p.png"));
  }

 private:
  static Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(OneRun, DragsAShapeInSteps) {
  const Json once = measured(shape({}));
  const Json m = measured(shape({"drag.steps=10"}));
  EXPECT_GT(m.at("iterations_mean"), 0);
  EXPECT_GE(m.at("iterations_max"), m.at("iterations_mean"));
  EXPECT_LT(m.at("iterations_mean"), once.at("iterations"));
  EXPECT_EQ(m.at("finite"), 1);
  const Shape before = read_shape(place("plane.off"));
  expect_success(shape({"drag.steps=3", "drag.back=true"}));
  EXPECT_LT((read_shape(place("out.off")).V - before.V).cwiseAbs().maxCoeff(), 1e-3);
  expect_refused(shape({"drag.steps=0"}), {"drag.steps is 0"});
}

TEST_F(OneRun, DragsADrawingInSteps) {
  // The closed form does not iterate.
  const Json m = measured(drawing({"drag.steps=5", "deformer=embedded_deformation"}));
  EXPECT_GT(m.at("iterations_mean"), 0);
  EXPECT_EQ(measured(drawing({"drag.steps=5"})).at("finite"), 1);
  expect_success(drawing({"drag.steps=2", "drag.back=true"}));
}

TEST_F(OneRun, MeasuresWhatItIsAsked) {
  const Json m = measured(
      shape({"measure.probes=[[1, 0, 0]]", "measure.detail=0.05", "measure.region={all: true}"}));
  EXPECT_GT(m.at("probe_1_z"), 0.1);
  EXPECT_GE(m.at("detail_rms"), 0);
  EXPECT_EQ(m.at("region.shear_max"), m.at("shear_max"));
  EXPECT_GT(measured(drawing({"measure.probes=[[95, 10]]"})).at("probe_1_y"), 0.1);
  EXPECT_TRUE(measured(frames({"measure.region={all: true}"})).contains("region.turn_max"));
  EXPECT_TRUE(measured(particles({})).contains("twist"));
  expect_refused(shape({"measure.probes=[[1, 0]]"}), {"measure.probes[0]", "3 coordinates"});
  expect_refused(shape({"measure.reference={graph.nodes: 3}"}), {"measure.reference", "one run"});
}

TEST_F(OneRun, DrawsAsItIsAsked) {
  // White margins are cut off, so that a panel is a little narrower than asked.
  const int panel = pictured(shape({"picture.width=40", "picture.rest=false"}));
  EXPECT_LE(panel, 40);
  EXPECT_GT(panel, 35);
  EXPECT_EQ(pictured(shape({"picture.width=40"})), 2 * panel);
  EXPECT_EQ(pictured(drawing({"picture.width=50", "picture.columns=1"})), 50);
  EXPECT_EQ(pictured(drawing({"picture.width=50", "picture.steps=true"})), 200);
  const int column = pictured(frames({"picture.width=40", "animation.pictured=1"}));
  EXPECT_LE(column, 40);
  EXPECT_GT(column, 35);
  EXPECT_EQ(pictured(frames({"picture.width=40", "animation.pictured=3"})), 3 * column);
  EXPECT_EQ(pictured(particles({"picture.width=40", "pictured=2"})), 80);
}

TEST_F(OneRun, ChangesWhatTheFilesSay) {
  expect_success(shape({"edit.1.by=[0, 0, 0.1]"}));
  EXPECT_LT(read_shape(place("out.off")).V.row(2).maxCoeff(), 0.2);
}

TEST_F(OneRun, RefusesKeysThatMeanNothing) {
  expect_refused(particles({"paint=[]"}), {"'paint' means nothing for particles"});
  expect_refused(shape({"shape.vertices=200"}), {"'shape' means nothing for a shape"});
  expect_refused(shape({"depth.front=left"}), {"'depth' means nothing for a shape"});
  expect_refused(drawing({"shape.vertices=9"}), {"'shape' means nothing for a drawing"});
  expect_refused(frames({"drag.steps=2"}), {"'drag' means nothing for a mesh animation"});
  expect_refused(particles({"cut=[]"}), {"'cut' means nothing for particles"});
  expect_refused(shape({"shape.file=plane.off"}), {"already names the file"});
  expect_refused(shape({"sweep={graph.nodes: [10, 20]}"}), {"unknown key 'sweep'"});
  const Ending ending = start(shape({"drawings.vertices=20"}));
  EXPECT_THAT(ending.err, AllOf(HasSubstr("unknown key 'drawings'"), HasSubstr("graph"),
                                Not(HasSubstr("drawing,")), Not(HasSubstr("did you mean"))));
  expect_refused(frames({"animation.generator=gallop"}), {"animation.file", "give one of them"});
  expect_refused(frames({"animation.sequence.every=1"}), {"animation.sequence.every"});
}

TEST_F(OneRun, NamesKeysOfOtherMethods) {
  const auto warnings = [&](const Words& words) {
    const Ending ending = start(words);
    EXPECT_EQ(ending.status, 0) << ending.err;
    return ending.err;
  };
  const std::string said = "has no effect on the deformer";
  EXPECT_THAT(warnings(drawing({"graph.nodes=30"})),
              AllOf(HasSubstr("graph.nodes=30"), HasSubstr(said + " arap_2d"),
                    HasSubstr("deformer=embedded_deformation")));
  EXPECT_THAT(warnings(drawing({"graph.nodes=30", "deformer=embedded_deformation"})),
              Not(HasSubstr(said)));
  EXPECT_THAT(warnings(shape({"arap_2d.refinements=1"})), HasSubstr(said));
  EXPECT_THAT(warnings(shape({"solver.epsilon=1e-7", "graph.neighbors=5"})), Not(HasSubstr(said)));
  EXPECT_THAT(warnings(shape({"deformer=primo", "primo.height=0.05"})), Not(HasSubstr(said)));
}

TEST_F(OneRun, OfAConfigTakesAnimationsInFiles) {
  const std::string edit = get("tube.yaml"), small = "picture: {width: 40, height: 30}\n";
  put("c/in-0.obj", tube_frame(0));
  put("c/in-1.obj", tube_frame(1));
  put("c/in.csv", particle_csv());
  put("c/frames.yaml", "animation: {file: in-%d.obj}\ngraph: {nodes: 20}\n" + small + edit);
  put("c/particles.yaml",
      "animation: {file: in.csv}\ngraph: {nodes: 12}\n" + small + get("stream.yaml"));
  expect_success({"run", "c/frames.yaml", "c/particles.yaml", "--out", "results"});
  const auto metrics = [&](const std::string& name) {
    return Json::parse(get("results/" + name + "/metrics.json"))["runs"][0]["metrics"];
  };
  EXPECT_EQ(metrics("frames").at("solves"), 2);
  EXPECT_EQ(metrics("particles").at("frames"), 20);
  expect_refused({"run", "c/frames.yaml", "animation.file=no-%d.obj"},
                 {"animation.file 'c/no-%d.obj'", "no file matches"});
}

}  // namespace
}  // namespace deformlab::test
