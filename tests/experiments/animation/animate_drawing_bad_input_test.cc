#include "tests/support/animated_bar.h"

namespace deformlab::test {
namespace {

/// One thing that `animate` must refuse of a drawing, and what it must say.
struct BadKeys {
  std::string name;
  Words more;
  Words says;
  std::string keys = {};
};

void PrintTo(const BadKeys& bad, std::ostream* out) { *out << bad.name; }

class RefusesKeys : public AnimateDrawing, public ::testing::WithParamInterface<BadKeys> {};

TEST_P(RefusesKeys, WithAClearMessage) {
  if (!GetParam().keys.empty()) put("keys.yaml", GetParam().keys);
  expect_refused(words("f-%02d.png", GetParam().more), GetParam().says);
}

BadKeys two(const std::string& name, const std::string& first, const std::string& second,
            const Words& says, const std::string& more = "") {
  return {name,
          {},
          says,
          std::string(kHeld) + more + "keyframes:\n" + key(first, "by: [0, 0]") +
              key(second, "by: [0, 9]")};
}

INSTANTIATE_TEST_SUITE_P(
    Of, RefusesKeys,
    ::testing::Values(
        two("FramesOutOfOrder", "frame: 9", "frame: 3",
            {"keyframe 2 (line 5 of", "frame 3", "keyframe 1 before it is of frame 9", "order"}),
        two("EqualFrames", "frame: 3", "frame: 3", {"keyframe 1", "keyframe 2", "frame 3"}),
        two("TimesOutOfOrder", "time: 2", "time: 1.5", {"keyframe 2", "time 1.5", "time 2"}),
        two("EqualTimes", "time: 0.5", "frame: 12", {"are both of frame 12"}),
        two("AFrameThatIsNoNumber", "frame: 0", "frame: soon", {"frame", "'soon'"}),
        two("AFrameThatIsNotWhole", "frame: 0", "frame: 2.5", {"frame", "'2.5'"}),
        two("ATimeThatIsNoNumber", "time: 0", "time: later", {"time", "'later'"}),
        two("ATimeThatIsNan", "time: 0", "time: .nan", {"time", "nan"}),
        two("ATimeThatIsInfinite", "time: 0", "time: .inf", {"time", "inf"}),
        two("FrameAndTime", "frame: 0", "frame: 2, time: 1", {"both 'frame' and 'time'"}),
        two("AFrameBelowZero", "frame: -3", "frame: 3", {"frame -3", "counted from 0"}),
        two("TooManyFrames", "frame: 0", "frame: 200000", {"more than 100000 frames"}),
        two("NoFrameBetween", "time: 0.1", "time: 0.11", {"no frame lies between", "fps"}),
        two("NoRateOfFrames", "frame: 0", "frame: 3", {"fps", "greater than 0"}, "fps: 0\n"),
        two("APose", "frame: 0", "frame: 3", {"'pose' is for meshes"}, "pose: 0\n"),
        two("AnUnknownInterpolation", "frame: 0", "frame: 3", {"cubic", "spline"},
            "interpolation: cubic\n"),
        BadKeys{"OneKeyframe",
                {},
                {"needs two or more entries, and it has 1"},
                kHeld + ("keyframes:\n" + key("frame: 0", "by: [0, 0]"))},
        BadKeys{"NoKeyframe", {}, {"two or more entries, and it has 0"}, kHeld},
        BadKeys{"FixedAlwaysAndMoved",
                {},
                {"a point is moved by edit", "of all frames"},
                "edit:\n  - {select: {point: [105, 40]}, fix: true}\nkeyframes:\n" +
                    key("frame: 0", "by: [0, 0]") + key("frame: 3", "by: [0, 9]")},
        BadKeys{"MovedTwiceAtOnce",
                {},
                {"a point is moved twice by keyframe 1"},
                "keyframes:\n  - {frame: 0, edit: [{select: {point: [105, 40]}, by: [0, 0]}, "
                "{select: {point: [105, 40]}, by: [0, 1]}]}\n" +
                    key("frame: 3", "by: [0, 9]")},
        BadKeys{"APatternWithoutANumber",
                {"--out", "frame.png"},
                {"--out 'frame.png'", "frame-%03d.png", "movie.webp"}},
        BadKeys{"AMovieWithANumber", {"--out", "movie-%d.webp"}, {"holds all frames in one file"}},
        BadKeys{"TwoNumbers", {"--out", "f-%d-%d.png"}, {"needs one %d"}},
        BadKeys{"AnUnknownFormat", {"--out", "f-%d.gif"}, {"unknown extension '.gif'"}},
        BadKeys{"CurvesOfABitmap", {"--out", "f-%d.svg"}, {"a bitmap has no curves"}},
        BadKeys{"TheDrawingIsAFrame", {"--out", "bar.pn%dg"}, {"unknown extension"}},
        BadKeys{"NoFolder", {"--out", "no/f-%d.png"}, {"there is no folder 'no'"}},
        BadKeys{"NoFolderOfAMovie", {"--out", "no/f.webp"}, {"there is no folder 'no'"}},
        BadKeys{"ThePictureIsAFrame", {"--picture", "f-03.png"}, {"a frame of --out"}},
        BadKeys{"TheKeysAreAFrame",
                {"--out", "keys%d.png", "--metrics", "keys1.png"},
                {"a frame of --out"}},
        BadKeys{"ASequence", {"animation.sequence.every=2"}, {"sequence.every"}},
        BadKeys{"Steps", {"output.steps=true"}, {"output.steps"}},
        BadKeys{"FramesOfAMeshToo", {"--frames", "in-%d.obj"}, {"animate needs a drawing, or"}},
        BadKeys{"NoRateOnTheCommandLine", {"fps=-1"}, {"fps is -1"}},
        BadKeys{"ANegativeLoop", {"loop=-1"}, {"loop is -1"}}),
    [](const auto& test) { return test.param.name; });

TEST_F(AnimateDrawing, RefusesADrawingThatDoesNotExist) {
  Words all = words("f-%02d.png");
  all[1] = "none.png";
  expect_refused(all, {"none.png", "cannot read"});
}

TEST_F(AnimateDrawing, RefusesAFrameThatWouldReplaceTheDrawing) {
  put_bitmap("f-03.png", bar());
  Words all = words("f-%02d.png");
  all[1] = "f-03.png";
  expect_refused(all, {"f-03.png", "a frame of --out"});
}

}  // namespace
}  // namespace deformlab::test
