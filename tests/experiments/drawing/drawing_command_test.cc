#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "geometry/shape/shape_io.h"
#include "tests/support/drawing_program.h"

// `deformlab deform` of drawings, and what it refuses.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

class DrawingCommand : public DrawingProgram {
 protected:
  Words deform(const std::string& in, const std::string& edit, const std::string& out) const {
    put("edit.yaml", edit);
    return {"deform", in, "--edit", "edit.yaml", "--out", out, "--vertices", "60"};
  }
  void expect_edit_refused(const std::string& entry, const Words& words) const {
    put_bitmap("bar.png", bar());
    expect_refused(deform("bar.png", "edit:\n  - " + entry + "\n", "out.png"), words);
  }
};

TEST_F(DrawingCommand, ByEmbeddedDeformationTellsHowItEnded) {
  put_bitmap("bar.png", bar());
  Words words = deform("bar.png", kEdit, "out.png");
  words.insert(words.end(), {"--nodes", "20", "deformer=embedded_deformation"});
  Words short_of_it = words, failing = words;
  short_of_it.emplace_back("solver.max_iterations=1");
  EXPECT_THAT(expect_success(short_of_it).err, HasSubstr("after solver.max_iterations steps"));
  failing.insert(failing.end(), {"energies.rotation=1e308", "--metrics", "m.json"});
  const auto before = contents();
  const Ending ending = start(failing);
  EXPECT_EQ(ending.status, 1);
  EXPECT_THAT(ending.err, HasSubstr("the solver failed"));
  EXPECT_THAT(changes_since(before), ::testing::IsEmpty());
}

TEST_F(DrawingCommand, BendsABitmap) {
  put_bitmap("bar.png", bar());
  Words words = deform("bar.png", kEdit, "out.png");
  words.insert(words.end(), {"--metrics", "m.json", "--picture", "p.png"});
  const Ending ending = expect_success(words);
  EXPECT_THAT(ending.out, HasSubstr("written to out.png"));
  const Bitmap out = read_png(place("out.png"));
  EXPECT_EQ(out.pixel(15, 40)[3], 255);   // the fixed end stays
  EXPECT_EQ(out.pixel(105, 60)[3], 255);  // the other one came down,
  EXPECT_GT(out.pixel(105, 60)[2], 180);  // and is blue
  EXPECT_EQ(out.pixel(105, 28)[3], 0);
  const auto metrics = nlohmann::json::parse(get("m.json"));
  EXPECT_LT(metrics.at("handle_rms").get<double>(), 1e-9);
  EXPECT_GT(read_png(place("p.png")).width, 100);
}

TEST_F(DrawingCommand, WithoutMovementTheBitmapStays) {
  put_bitmap("bar.png", bar());
  expect_success(deform("bar.png", "edit:\n  - {select: {point: [60, 40]}, fix: true}\n", "o.png"));
  const Bitmap before = bar(), after = read_png(place("o.png"));
  ASSERT_EQ(after.width, before.width);
  int differ = 0;
  for (std::size_t i = 0; i < before.rgba.size(); i += 4) {
    differ += before.rgba[i + 3] != after.rgba[i + 3];
  }
  EXPECT_LT(differ, 5);
}

TEST_F(DrawingCommand, BendsCurvesThatStayCurves) {
  put_svg("bar.svg", "<path d='M10 25 H110 V55 C80 70 40 60 10 55 Z' fill='#c33'/>");
  expect_success(deform("bar.svg", kEdit, "out.svg"));
  EXPECT_THAT(get("out.svg"), HasSubstr("<path"));
  EXPECT_THAT(get("out.svg"), HasSubstr("C"));
  expect_success(deform("bar.svg", kEdit, "out.png"));
  expect_success(deform("bar.svg", kEdit, "out.obj"));
  EXPECT_EQ(read_shape(place("out.obj")).faces.front().size(), 3u);
}

TEST_F(DrawingCommand, TurnsARotationHandle) {
  put_bitmap("bar.png", bar());
  expect_success(deform(
      "bar.png", "edit:\n  - {select: {point: [60, 40]}, rotate: 90, by: [0, 5]}\n", "out.png"));
  const Bitmap out = read_png(place("out.png"));
  EXPECT_EQ(out.pixel(20, 40)[3], 0);  // it stands upright now
}

TEST_F(DrawingCommand, TakesPolygonsAndFlatMeshes) {
  put("bar.txt", "10 25\n110 25\n110 55\n10 55\n");
  expect_success(deform("bar.txt", kEdit, "out.svg"));
  put("bar.obj", "v 10 25 0\nv 110 25 0\nv 110 55 0\nv 10 55 0\nf 1 2 3\nf 1 3 4\n");
  Words words = deform("bar.obj", kEdit, "out.obj");
  words.push_back("deformer=arap_2d");
  expect_success(words);
  EXPECT_EQ(read_shape(place("out.obj")).V.cols(), 4);
}

TEST_F(DrawingCommand, BendsByEmbeddedDeformationToo) {
  put_bitmap("bar.png", bar());
  Words words = deform("bar.png", kEdit, "out.png");
  words.insert(words.end(), {"deformer=embedded_deformation", "--nodes", "12"});
  expect_success(words);
}

TEST_F(DrawingCommand, HandlesMayCoincideOrCrowdInOneTriangle) {
  put_bitmap("bar.png", bar());
  std::string edit = "edit:\n  - {select: {point: [15, 40]}, fix: true}\n";
  for (const char* p : {"100.0, 40", "100.5, 40", "100, 40.5", "100.3, 40.3", "100.0, 40"}) {
    edit += std::string("  - {select: {point: [") + p + "]}, by: [0, 20]}\n";
  }
  expect_success(deform("bar.png", edit, "out.png"));
  EXPECT_EQ(read_png(place("out.png")).pixel(100, 60)[3], 255);
}

TEST_F(DrawingCommand, AHandleMayLieOnTheBoundary) {
  put_bitmap("bar.png", bar());
  expect_success(deform("bar.png",
                        "edit:\n  - {select: {point: [15, 40]}, fix: true}\n"
                        "  - {select: {nearest: [110, 25]}, by: [5, 5]}\n",
                        "out.png"));
}

TEST_F(DrawingCommand, RefusesAHandleOutside) {
  expect_edit_refused("{select: {point: [60, 75]}, by: [1, 1]}", {"60", "75", "55"});
  expect_edit_refused("{select: {circle: {center: [3, 3], radius: 1}}, by: [1, 1]}",
                      {"selects no vertex"});
  expect_edit_refused("{select: {nearest: [1, 2, 3]}, fix: true}", {"two coordinates"});
}

TEST_F(DrawingCommand, RefusesPicturesThatShowNothing) {
  put_bitmap("empty.png", Bitmap(30, 30));
  expect_refused(deform("empty.png", kEdit, "o.png"), {"empty.png", "opaque"});
  put_bitmap("dot.png", Bitmap(1, 1));
  expect_refused(deform("dot.png", kEdit, "o.png"), {"dot.png", "1×1"});
  Bitmap noise(40, 40);
  for (std::size_t i = 0; i < noise.rgba.size(); ++i) {
    noise.rgba[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>(i * 2654435761u >> 11);
  }
  put_bitmap("noise.png", noise);
  expect_refused(deform("noise.png", kEdit, "o.png"), {"noise.png", "background"});
}

TEST_F(DrawingCommand, RefusesBrokenFiles) {
  put_bitmap("bar.png", bar());
  put("cut.png", get("bar.png").substr(0, 150));
  expect_refused(deform("cut.png", kEdit, "o.png"), {"cut.png"});
  put("no.svg", "<svg xmlns='http://www.w3.org/2000/svg'");
  expect_refused(deform("no.svg", kEdit, "o.png"), {"no.svg"});
  put_svg("text.svg", "<text x='3' y='30'>words</text>");
  expect_refused(deform("text.svg", kEdit, "o.svg"), {"o.svg", "no curves", "text"});
  put("line.txt", "1 1\n5 5\n");
  expect_refused(deform("line.txt", kEdit, "o.png"), {"line.txt"});
  put("eight.txt", "10 10\n90 60\n90 10\n10 60\n");
  expect_refused(deform("eight.txt", kEdit, "o.png"), {"eight.txt", "cross"});
  expect_refused(deform("missing.png", kEdit, "o.png"), {"missing.png"});
}

TEST_F(DrawingCommand, TakesAPathThatCrossesItselfAndFetchesNothing) {
  put_svg("eight.svg", "<path d='M10 20 L110 60 V20 L10 60 Z' stroke='#000' stroke-width='12'/>");
  expect_success(deform("eight.svg", kEdit, "out.png"));
  put("secret.svg", "<svg xmlns='http://www.w3.org/2000/svg'><rect width='9' height='9'/></svg>");
  put("linked.svg",
      "<!DOCTYPE svg [<!ENTITY x SYSTEM 'secret.svg'>]>"
      "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' "
      "width='120' height='80'><rect x='10' y='25' width='100' height='30'/>"
      "<image xlink:href='http://localhost:9/a.png' width='5' height='5'/></svg>");
  const Ending ending = start(deform("linked.svg", kEdit, "out.svg"));
  EXPECT_THAT(ending.status, ::testing::AnyOf(0, 2)) << ending.err;
  if (ending.status == 0) {
    EXPECT_THAT(get("out.svg"), ::testing::Not(HasSubstr("localhost")));
  }
}

TEST_F(DrawingCommand, RefusesOutputsThatCannotBe) {
  put_bitmap("bar.png", bar());
  expect_refused(deform("bar.png", kEdit, "out.svg"), {"out.svg"});
  expect_refused(deform("bar.png", kEdit, "out.jpg"), {"out.jpg"});
  expect_refused(deform("bar.png",
                        "edit:\n  - {select: {point: [15, 40]}, fix: true}\n"
                        "  - {select: {point: [105, 40]}, by: [9e6, 0]}\n",
                        "out.png"),
                 {"out.png"});
}

TEST_F(DrawingCommand, WritesTheStages) {
  put_bitmap("bar.png", bar());
  Words words = deform("bar.png", kEdit, "out.obj");
  words.push_back("output.steps=true");
  expect_success(words);
  const Shape result = read_shape(place("out.obj"));
  const Shape intermediate = read_shape(place("out.intermediate.obj"));
  const Shape fitted = read_shape(place("out.fitted.obj"));
  EXPECT_EQ(intermediate.V.cols(), result.V.cols());
  EXPECT_EQ(fitted.V.cols(), 3 * std::ssize(result.faces));
  EXPECT_GT((intermediate.V - result.V).norm(), 1e-3);
  words.push_back("deformer=embedded_deformation");
  expect_refused(words, {"output.steps", "arap_2d"});
}

TEST_F(DrawingCommand, PaintsByAMask) {
  put_bitmap("bar.png", bar());
  Bitmap mask(120, 80);
  for (int y = 0; y < 80; ++y) {
    for (int x = 40; x < 80; ++x) mask.pixel(x, y)[3] = 255;  // black
  }
  put_bitmap("mask.png", mask);
  const auto distortion_with = [&](const std::string& paint) {
    put("c.yaml", "drawing: {file: bar.png, vertices: 80}\n" + paint +
                      "edit:\n"
                      "  - {select: {point: [15, 40]}, fix: true}\n"
                      "  - {select: {point: [60, 40]}, by: [0, 12]}\n"
                      "  - {select: {point: [105, 40]}, by: [0, 0]}\n");
    expect_success({"run", "c.yaml", "--out", "results"});
    const auto metrics = nlohmann::json::parse(get("results/c/metrics.json"));
    return metrics.at("runs").at(0).at("metrics");
  };
  const auto stiff = distortion_with("paint: [{mask: mask.png}]\n");
  const auto weak = distortion_with("paint: [{mask: mask.png, weight: 1.0001}]\n");
  EXPECT_LT(stiff.at("painted_shear_max").get<double>(),
            0.1 * weak.at("painted_shear_max").get<double>());
  put_bitmap("nothing.png", Bitmap(120, 80));
  put("c.yaml", get("c.yaml").replace(get("c.yaml").find("mask.png"), 8, "nothing.png"));
  expect_refused({"run", "c.yaml", "--out", "results"}, {"paint entry 1", "paints no triangle"});
}

TEST_F(DrawingCommand, TakesAVeryWideImage) {
  Bitmap wide(20000, 240);
  for (int y = 20; y < 220; ++y) {
    for (int x = 5; x < 19995; ++x) wide.pixel(x, y)[3] = 255;
  }
  put_bitmap("wide.png", wide);
  expect_success(deform("wide.png",
                        "edit:\n  - {select: {point: [100, 120]}, fix: true}\n"
                        "  - {select: {point: [19900, 120]}, by: [0, 50]}\n",
                        "out.png"));
  EXPECT_GE(read_png(place("out.png")).width, 19990);
}

/// How many of the pictures' bytes differ by more than a quarter.
int differing(const Bitmap& a, const Bitmap& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) count += std::abs(a.rgba[i] - b.rgba[i]) > 64;
  return count;
}

TEST_F(DrawingCommand, AnSvgShowsWhatThePngShows) {
  // The arms of a cross come in front of its body.
  const std::string cross = "M50 5H70V25H115V37H70V75H50V37H5V25H50Z";
  const std::string edit =
      "edit:\n"
      "  - {select: {point: [60, 70]}, fix: true}\n"
      "  - {select: {point: [60, 10]}, fix: true}\n"
      "  - {select: {point: [9, 31]}, to: [60, 55]}\n"
      "  - {select: {point: [111, 31]}, to: [64, 62]}\n";
  put_svg("depth.svg",
          "<rect x='5' y='25' width='47' height='12' fill='#c33'/>"
          "<rect x='68' y='25' width='47' height='12' fill='#3a3'/>"
          "<rect x='50' y='5' width='20' height='70' fill='#88a'/>");
  put_svg("even_odd.svg", "<path fill-rule='evenodd' fill='#36c' d='" + cross + "'/>");
  put_svg("stroke.svg", "<path fill='#36c' stroke='#c20' stroke-width='3' d='" + cross + "'/>");
  put_svg("clip.svg", "<clipPath id='c'><path clip-rule='evenodd' d='" + cross +
                          "'/></clipPath><g clip-path='url(#c)'><rect width='120' height='80' "
                          "fill='#ca3'/><circle cx='60' cy='31' r='25' fill='#36a'/></g>");
  for (const std::string name : {"depth", "even_odd", "stroke", "clip"}) {
    for (const std::string out : {"out.svg", "out.png"}) {
      Words words = deform(name + ".svg", edit, out);
      words.insert(words.end(), {"output.page=keep", "--vertices", "150"});
      expect_success(words);
    }
    Words again = deform("out.svg", "edit:\n  - {select: {all: true}, fix: true}\n", "again.png");
    again.emplace_back("output.page=keep");
    expect_success(again);
    const Bitmap shown = read_png(place("again.png")), png = read_png(place("out.png"));
    ASSERT_EQ(shown.rgba.size(), png.rgba.size());
    const double bytes = static_cast<double>(png.rgba.size());
    EXPECT_LT(differing(shown, png), 0.004 * bytes) << name;  // a hidden arm would be 0.01
  }
}

TEST_F(DrawingCommand, CurvesAreSplitOnlyAsFarAsTheirDeformationNeeds) {
  put_svg("bar.svg", "<rect x='10' y='25' width='100' height='30' fill='#c33'/>");
  expect_success(deform("bar.svg", "edit:\n  - {select: {point: [60, 40]}, fix: true}\n", "o.svg"));
  const std::string text = get("o.svg");
  EXPECT_EQ(std::ranges::count(text, 'C'), 4) << text;
}

TEST_F(DrawingCommand, AnSvgKeepsNamesGroupsAndLinks) {
  put("named.svg",
      "<svg xmlns='http://www.w3.org/2000/svg' xmlns:inkscape='urn:x' width='120' height='80'>"
      "<title>figure</title><g id='layer1' class='ink' inkscape:label='Ink'>"
      "<rect id='bar' x='10' y='25' width='100' height='30' fill='#c63' "
      "style='mix-blend-mode: multiply'><desc>a bar</desc></rect>"
      "<a href='https://example.org'><circle class='dot' cx='60' cy='40' r='5'/></a></g></svg>");
  expect_success(deform("named.svg", kEdit, "out.svg"));
  const std::string text = get("out.svg");
  for (const char* kept : {"<title>figure</title>", "id=\"layer1\"", "class=\"ink\"",
                           "inkscape:label=\"Ink\"", "id=\"bar\"", "mix-blend-mode: multiply",
                           "<desc>a bar</desc>", "href=\"https://example.org\"", "class=\"dot\""}) {
    EXPECT_THAT(text, HasSubstr(kept));
  }
}

TEST_F(DrawingCommand, APngOfAnSvgShowsWhatCannotBeBentAsCurves) {
  put_svg("filtered.svg",
          "<mask id='m'><rect width='60' height='80' fill='#fff'/></mask>"
          "<rect x='10' y='25' width='100' height='30' fill='#c33' opacity='0.99'/>"
          "<rect x='10' y='25' width='100' height='30' fill='#33c' mask='url(#m)'/>");
  Words words =
      deform("filtered.svg", "edit:\n  - {select: {point: [60, 40]}, fix: true}\n", "o.png");
  words.emplace_back("output.resolution=1");
  expect_success(words);
  const Bitmap out = read_png(place("o.png"));
  EXPECT_GT(out.pixel(30, 40)[2], 180);  // the mask shows the left half,
  EXPECT_LT(out.pixel(90, 40)[2], 90);   // and hides the right one
  EXPECT_THAT(expect_success(deform("filtered.svg", kEdit, "o.svg")).err, HasSubstr("masks"));
}

TEST_F(DrawingCommand, AnOpaquePictureBendsAsARectangle) {
  Bitmap photo(48, 32);
  for (std::size_t i = 0; i < photo.rgba.size(); ++i) {
    photo.rgba[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>(i * 2654435761u >> 11);
  }
  put_bitmap("photo.png", photo);
  const std::string edit =
      "edit:\n  - {select: {point: [3, 16]}, fix: true}\n"
      "  - {select: {point: [45, 16]}, by: [0, 5]}\n";
  expect_refused(deform("photo.png", edit, "o.png"), {"drawing.background=none"});
  Words words = deform("photo.png", edit, "o.png");
  words.insert(words.end(), {"output.page=keep", "drawing.background=none"});
  expect_success(words);
  EXPECT_EQ(read_png(place("o.png")).pixel(10, 16)[3], 255);
  words.back() = "drawing.background=2";
  expect_refused(words, {"drawing.background", "from 0 to 1", "none"});
}

TEST_F(DrawingCommand, FormatsThatAreNotReadAreNamed) {
  for (const char* name : {"a.svgz", "a.gif", "a.bmp"}) {
    put(name, "x");
    expect_refused(deform(name, kEdit, "o.png"), {name, "cannot read", ".webp"});
  }
}

TEST_F(DrawingCommand, APartWithoutAHandleStaysAndIsNamed) {
  put("two.obj",
      "v 10 25 0\nv 110 25 0\nv 110 55 0\nv 10 55 0\nv 10 65 0\nv 110 65 0\nv 110 75 0\n"
      "f 1 2 3\nf 1 3 4\nf 5 6 7\n");
  Words words = deform("two.obj", kEdit, "out.obj");
  words.push_back("deformer=arap_2d");
  EXPECT_THAT(expect_success(words).err, HasSubstr("has no handle: it stays where it is"));
  EXPECT_EQ(read_shape(place("out.obj")).V.col(6), Eigen::Vector3d(110, 75, 0));
}

TEST_F(DrawingCommand, HandlesThatCollapseAndComeBackLeaveTheShapeAsItWas) {
  put_bitmap("bar.png", bar());
  put("collapse.yaml",
      "drawing: {file: bar.png, vertices: 80}\n"
      "edit:\n"
      "  - {select: {point: [20, 40]}, to: [60, 40]}\n"
      "  - {select: {point: [100, 40]}, to: [60, 40]}\n"
      "drag: {steps: 8, back: true}\n"
      "claims:\n"
      "  - {name: finite, measure: finite, equals: 1}\n"
      "  - {name: returns, measure: edge_error_mean, at_most: 1e-9}\n");
  expect_success({"run", "collapse.yaml", "--out", "results"});
}

}  // namespace
}  // namespace deformlab::test
