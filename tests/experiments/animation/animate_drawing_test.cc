#include <webp/demux.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/support/animated_bar.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

TEST_F(AnimateDrawing, MakesOnePngForEachFrame) {
  const Ending ending = expect_success(words("f-%02d.png"));
  EXPECT_THAT(ending.out, HasSubstr("13 frames, 13 of them made now"));
  const Bitmap first = read_png(place("f-00.png")), last = read_png(place("f-12.png"));
  EXPECT_EQ(first.width, last.width) << "all frames show one page";
  EXPECT_EQ(first.height, last.height);
  EXPECT_GT(first.height, 80) << "which holds the lowest of them";
  EXPECT_EQ(first.pixel(100, 40)[3], 255);
  EXPECT_EQ(last.pixel(100, 40)[3], 0);
  EXPECT_EQ(last.pixel(103, 78)[2], 220);
  EXPECT_FALSE(exists("f-13.png") || exists("f-%02d.png.progress"));
}

TEST_F(AnimateDrawing, GoesBetweenKeysAsTheInterpolationSays) {
  struct Expected {
    std::string kind;
    double at_two, at_six;
  };
  for (const auto& [kind, at_two, at_six] :
       {Expected{"linear", 10, 25}, {"smooth", 10, 23.125}, {"spline", 11.186, 26.706}}) {
    expect_success(words("o-%02d.obj", {"interpolation=" + kind}));
    EXPECT_NEAR(way_of_the_end(0), 0, 1e-6) << kind;
    EXPECT_NEAR(way_of_the_end(2), at_two, 1e-3) << kind;
    EXPECT_NEAR(way_of_the_end(4), 20, 1e-6) << kind;
    EXPECT_NEAR(way_of_the_end(6), at_six, 1e-3) << kind;
    EXPECT_NEAR(way_of_the_end(12), 40, 1e-6) << kind;
  }
}

TEST_F(AnimateDrawing, TimesAreTakenByTheRateOfFrames) {
  expect_success(words("a-%02d.svg.obj"));
  put("keys.yaml", std::string(kHeld) + "fps: 8\nkeyframes:\n" + key("time: 0", "by: [0, 0]") +
                       key("time: 0.5", "by: [0, 20]") + key("time: 1.5", "by: [0, 40]"));
  expect_success(words("b-%02d.svg.obj"));
  for (int frame = 0; frame <= 12; ++frame) {
    EXPECT_EQ(get(name("a-", frame, ".svg.obj")), get(name("b-", frame, ".svg.obj"))) << frame;
  }
}

TEST_F(AnimateDrawing, AnAngleGoesRoundSeveralTimes) {
  put("keys.yaml", std::string(kHeld) + "keyframes:\n" + key("frame: 0", "by: [0, 0]") +
                       key("frame: 16", "rotate: 720"));
  const Ending ending = start(words("o-%02d.obj"));
  EXPECT_EQ(ending.status, 3) << ending.err;  // a flat bar cannot turn round where it is held
  EXPECT_THAT(ending.err, ::testing::HasSubstr("turned inside out"));
  const Eigen::Vector2d beside(109, 40);
  const auto angle = [&](int frame) {
    const Eigen::Vector2d arm = place_in(frame, beside) - place_in(frame, {105, 40});
    return std::atan2(arm.y(), arm.x()) * 180 / std::numbers::pi;
  };
  for (const int frame : {0, 2, 4, 6, 8, 10, 14}) {
    EXPECT_NEAR(std::remainder(angle(frame) - angle(0) - 45.0 * frame, 360), 0, 6) << frame;
  }
}

TEST_F(AnimateDrawing, AHandleGoesBetweenTheKeyframesThatNameIt) {
  put("keys.yaml",
      "keyframes:\n"
      "  - {frame: 0, edit: [{select: {point: [15, 40]}, by: [0, 0]}]}\n" +
          key("frame: 2", "by: [0, 20]") + key("frame: 6", "by: [0, 40]") +
          "  - {frame: 8, edit: [{select: {point: [15, 40]}, by: [0, -16]}]}\n");
  expect_success(words("o-%02d.obj"));
  EXPECT_NEAR(way_of_the_end(0), 20, 1e-6);
  EXPECT_NEAR(way_of_the_end(4), 30, 1e-6);
  EXPECT_NEAR(way_of_the_end(8), 40, 1e-6);
  EXPECT_NEAR(place_in(4, {15, 40}).y(), 32, 1e-6);
}

TEST_F(AnimateDrawing, AVectorDrawingStaysOne) {
  put_svg("bar.svg", "<rect x='10' y='25' width='100' height='30' fill='#d63'/>");
  Words all = words("f-%02d.svg");
  all[1] = "bar.svg";
  expect_success(all);
  const std::string first = get("f-00.svg"), last = get("f-12.svg");
  EXPECT_THAT(first, HasSubstr("<path"));
  const auto box = [](const std::string& svg) { return svg.substr(svg.find("viewBox"), 30); };
  EXPECT_EQ(box(first), box(last));
  EXPECT_NE(first, last);
}

TEST_F(AnimateDrawing, AMovieHasAllFramesInOneFile) {
  expect_success(words("f-%02d.png"));
  expect_success(words("movie.webp", {"fps=8", "loop=3"}));
  const std::string bytes = get("movie.webp");
  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
  WebPAnimDecoderOptions options;
  WebPAnimDecoderOptionsInit(&options);
  const std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> movie(
      WebPAnimDecoderNew(&data, &options), WebPAnimDecoderDelete);
  ASSERT_NE(movie, nullptr);
  WebPAnimInfo info;
  ASSERT_TRUE(WebPAnimDecoderGetInfo(movie.get(), &info));
  EXPECT_EQ(info.frame_count, 13u);
  EXPECT_EQ(info.loop_count, 3u);
  std::uint8_t* pixels = nullptr;
  int time = 0;
  for (int frame = 0; frame < 13; ++frame) {
    ASSERT_TRUE(WebPAnimDecoderGetNext(movie.get(), &pixels, &time));
    EXPECT_EQ(time, 125 * (frame + 1)) << "the frame ends then";
    const Bitmap expected = read_png(place(name("f-", frame, ".png")));
    ASSERT_EQ(expected.width, static_cast<int>(info.canvas_width));
    int wrong = 0;
    for (std::size_t i = 0; i < expected.rgba.size(); i += 4) {
      const bool seen = expected.rgba[i + 3] > 0;
      wrong += expected.rgba[i + 3] != pixels[i + 3];
      for (int c = 0; c < 3; ++c) wrong += seen && expected.rgba[i + c] != pixels[i + c];
    }
    EXPECT_EQ(wrong, 0) << frame;
  }
  expect_success(words("again.webp", {"fps=8", "loop=3"}));
  EXPECT_TRUE(get("again.webp") == bytes);
}

TEST_F(AnimateDrawing, MeasuresAndPicturesAllFrames) {
  const Words more{"--metrics", "m.json", "--picture", "p.png", "pictured=3", "picture.width=80"};
  expect_success(words("f-%02d.png", more));
  const auto m = nlohmann::json::parse(get("m.json"));
  EXPECT_EQ(m.at("frames"), 13);
  EXPECT_EQ(m.at("solves"), 13);
  EXPECT_EQ(m.at("handles"), 2);
  EXPECT_EQ(m.at("depth_jumps"), 0);
  EXPECT_LT(m.at("handle_max").get<double>(), 1e-9);
  EXPECT_EQ(get("p.png").substr(1, 3), "PNG");
}

// The arms fold over the body. Where they meet, their overlaps become one region.
TEST_F(AnimateDrawing, ArmsThatCrossStayInFrontOfTheBody) {
  const std::string right = "{select: {point: [350, 193]}, by: ",
                    left = "{select: {point: [50, 193]}, by: ",
                    head = "{select: {point: [200, 80]}, by: ";
  put("arms.yaml",
      "interpolation: spline\nedit:\n  - {select: {point: [120, 440]}, fix: true}\n"
      "  - {select: {point: [280, 440]}, fix: true}\nkeyframes:\n"
      "  - {frame: 0, edit: [" +
          right + "[0, 0]}, " + left + "[0, 0]}, " + head +
          "[0, 0]}]}\n"
          "  - {frame: 12, edit: [" +
          right + "[-160, 60]}, " + head +
          "[20, 0]}]}\n"
          "  - {frame: 24, edit: [" +
          right + "[20, -150]}, " + left +
          "[180, 40]}]}\n"
          "  - {frame: 36, edit: [" +
          right + "[0, 0]}, " + left + "[0, 0]}, " + head + "[0, 0]}]}\n");
  const Ending ending =
      start({"animate", DEFORMLAB_SOURCE_DIR "/configs/drawings/gingerbread.svg", "--edit",
             "arms.yaml", "--out", "a-%02d.obj", "--vertices", "200", "--metrics", "m.json"});
  EXPECT_EQ(ending.status, 3) << ending.err;  // the shoulders fold
  EXPECT_THAT(ending.err, ::testing::HasSubstr("turned inside out"));
  const int jumps = nlohmann::json::parse(get("m.json")).at("depth_jumps");
  EXPECT_LT(jumps, 60) << "one vote for each region changed 125 pairs, among them those of an arm";
}

TEST_F(AnimateDrawing, AnotherMethodPosesItToo) {
  expect_success(words("o-%02d.obj", {"deformer=embedded_deformation"}));
  EXPECT_NEAR(way_of_the_end(4), 20, 1.5);
}

TEST_F(AnimateDrawing, TellsOfHandlesThatMissAndWithStrictWritesNothing) {
  put("keys.yaml", std::string(kHeld) + "keyframes:\n" + key("frame: 0", "by: [0, 0]") +
                       "  - {frame: 2, edit: [{select: {point: [105, 40]}, by: [0, 0]}, {select: "
                       "{point: [104, 40]}, by: [0, 30]}, {select: {point: [106, 40]}, by: [0, "
                       "-30]}, {select: {point: [105, 39]}, by: [30, 0]}, {select: {point: [105, "
                       "41]}, by: [20, 0]}]}\n");
  const auto before = contents();
  const Ending strict = start(words("f-%02d.png", {"--strict"}));
  EXPECT_EQ(strict.status, 3);
  EXPECT_THAT(strict.err, HasSubstr("not done: frame 0: the handle at"));
  EXPECT_THAT(changes_since(before), ::testing::IsEmpty());
  EXPECT_EQ(start(words("f-%02d.png")).status, 3);
  EXPECT_TRUE(exists("f-02.png"));
}

}  // namespace
}  // namespace deformlab::test
