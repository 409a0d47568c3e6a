#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/drawing_program.h"

// What `deformlab deform` says about drawings and edits of drawings that it cannot use: the cause,
// the file or key, the value, and what helps.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class DrawingMessages : public DrawingProgram {
 protected:
  Words deform(const std::string& in, const Words& more = {},
               const std::string& out = "o.png") const {
    put("ok.yaml", kEdit);
    Words words{"deform", in, "--edit", "ok.yaml", "--out", out, "--vertices", "60"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Words edited(const std::string& entries) const {
    put_bitmap("bar.png", bar());
    Words words = deform("bar.png");
    put("edit.yaml", "edit:\n" + entries);
    words[3] = "edit.yaml";
    return words;
  }
};

TEST_F(DrawingMessages, AboutFiles) {
  put_bitmap("clear.png", Bitmap(30, 30));
  expect_refused(deform("clear.png"), {"clear.png", "greatest opacity is 0", "drawing.threshold"});
  Bitmap plain(30, 30);
  std::ranges::fill(plain.rgba, std::uint8_t{255});
  put_bitmap("plain.png", plain);
  expect_refused(deform("plain.png"), {"plain.png", "like its border", "drawing.background=none"});
  put("svg.png", "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'/>");
  expect_refused(deform("svg.png"), {"svg.png", "not those of a PNG, JPEG or WebP"});
  put("not.svg", "\x89PNG");
  expect_refused(deform("not.svg"), {"not.svg", "not an SVG"});
  std::filesystem::create_directory(place("folder.png"));
  expect_refused(deform("folder.png"), {"folder.png", "it is a folder"});
  put_svg("nothing.svg", "<rect x='500' width='9' height='9'/>");
  expect_refused(deform("nothing.svg"), {"nothing.svg", "nothing on its page"});
  put("words.txt", "0 0\na b c\n");
  expect_refused(deform("words.txt"), {"words.txt", "line 2", "'x y'", "found 'a b c'"});
  for (const char* name : {"a.gltf", "noextension"}) {
    put(name, "x");
    expect_refused(deform(name), {name, "format", ".png", ".webp", ".svg", ".txt", ".off"});
  }
}

TEST_F(DrawingMessages, AboutPlacesHaveTwoCoordinates) {
  const auto refused = [&](const std::string& entry, const Words& words) {
    const Words command = edited("  - " + entry + "\n");
    expect_refused(command, words);
    EXPECT_THAT(start(command).err, Not(HasSubstr(", 0]")));
    EXPECT_THAT(start(command).err, Not(HasSubstr("sphere")));
  };
  refused("{select: {box: {min: [300, 300], max: [400, 400]}}, by: [1, 1]}",
          {"[10, 25]", "[110, 55]"});
  refused("{select: {box: {min: [9, 9], max: [5, 5]}}, by: [1, 1]}", {"min [9, 9]", "max [5, 5]"});
  refused("{select: {all: true}, scale: {factor: -1}}", {"[-1, -1]", "above 0"});
  refused("{select: {all: true}, matrix: [[1, 0, 0], [0, 1, 0], [0, 1, 1]]}", {"[0, 0, 1]"});
  refused("{select: {circle: {center: [60, 40], radius: -3}}, by: [1, 1]}",
          {"select.circle.radius is -3", "at least 0"});
  refused("{select: {circle: {center: [60, 40]}}, by: [1, 1]}", {"'radius'", "select.circle"});
  refused("{select: {circle: {center: [60, 40], radius: 9}, all: true}, by: [1, 1]}",
          {"exactly one of", "circle"});
  refused("{select: {point: [15, 40]}, by: [1e300, 0]}", {"beyond the range", "[1e+300, 40]"});
}

TEST_F(DrawingMessages, AboutKeys) {
  put_bitmap("bar.png", bar());
  const auto refused = [&](const std::string& key, const Words& words) {
    expect_refused(deform("bar.png", {key}), words);
  };
  refused("drawing.background=2", {"drawing.background is '2'", "override", "0 to 1", "none"});
  refused("output.resolution=1e6", {"120000000×80000000", "lower output.resolution (now 1e+06)"});
  EXPECT_THAT(start(deform("bar.png", {"output.resolution=1e6"})).err, Not(HasSubstr("handles")));
  refused("paint=[{mask: ok.yaml}]", {"paint entry 1", "ok.yaml", "PNG"});
  refused("paint=[{select: {all: true}, weight: -1}]", {"paint entry 1", "the weight is -1"});
  refused("paint=[{select: {circle: {radius: 1}}}]", {"select.circle"});
  refused("depth.parts=[{select: {circle: {center: [5, 5], radius: 1}}, level: 1}]",
          {"depth.parts entry 1", "[110, 55]"});
  const Ending cut = expect_success(deform("bar.png", {"cut=[[[300, 300], [400, 410]]]"}));
  EXPECT_THAT(cut.err, HasSubstr("cut[0], from (300, 300) to (400, 410), cuts nothing"));
}

TEST_F(DrawingMessages, AboutHandlesThatDoNotArrive) {
  const std::string entries =
      "  - {select: {point: [60, 40]}, fix: true}\n  - {select: {point: [60, 40]}, by: [9, 0]}\n";
  const Ending ending = start(edited(entries));
  EXPECT_EQ(ending.status, 3);
  for (const char* word : {"not done", "(60, 40)", "4.5 short", "drawing.vertices"})
    EXPECT_THAT(ending.err, HasSubstr(word));
  for (const char* key : {"graph.nodes", "energies"})
    EXPECT_THAT(ending.err, Not(HasSubstr(key))) << "arap_2d has no such key";
  Words words = edited(entries);
  words.insert(words.end(), {"deformer=embedded_deformation", "--nodes", "20"});
  EXPECT_THAT(start(words).err, HasSubstr("graph.nodes"));
}

TEST_F(DrawingMessages, AnSvgWithoutASizeIsRead) {
  put("nosize.svg",
      "<svg xmlns='http://www.w3.org/2000/svg'><rect x='10' y='25' width='100' "
      "height='30'/></svg>");
  expect_success(deform("nosize.svg", {"output.resolution=1", "output.page=[0, 0, 120, 80]"}));
  EXPECT_EQ(read_png(place("o.png")).pixel(15, 40)[3], 255);
}

}  // namespace
}  // namespace deformlab::test
