#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pugixml.hpp>

#include "tests/support/drawing_program.h"

// What an SVG of a deformed drawing keeps, and what the program says about the rest.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class DrawingSvg : public DrawingProgram {
 protected:
  Words deform(const std::string& body, const std::string& edit) const {
    put_svg("in.svg", body);
    put("edit.yaml", edit);
    return {"deform", "in.svg", "--edit", "edit.yaml", "--out", "out.svg", "--vertices", "60"};
  }
  /// The styles that the elements of the output have, by their ids.
  std::map<std::string, std::string> styles(const std::string& body) const {
    expect_success(deform(body, kEdit));
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(get("out.svg").c_str()));
    std::map<std::string, std::string> result;
    for (const auto& found : document.select_nodes("//*[@id]"))
      result[found.node().attribute("id").value()] = found.node().attribute("style").value();
    return result;
  }
};

constexpr const char* kBars =
    "<g id='g' class='ink layer'><rect id='a' class='x' x='10' y='25' width='50' height='30'/>"
    "<rect id='b' x='55' y='25' width='55' height='30' fill='#c33'/></g>";

TEST_F(DrawingSvg, KeepsTheBlendModesOfStyleSheets) {
  const std::string multiply = "mix-blend-mode: multiply", screen = "mix-blend-mode: screen";
  const auto with = [&](const std::string& sheet) {
    return styles("<style>" + sheet + "</style>" + kBars);
  };
  auto found = with(".x { fill: #00f; mix-blend-mode: multiply; }");
  EXPECT_EQ(found["a"], multiply);
  found = with("\n.x {\n\tfill: #00f;\n\tmix-blend-mode: multiply;\n}\n");
  EXPECT_EQ(found["a"], multiply);
  EXPECT_EQ(found["b"], "");
  found = with("/* { */ rect, .none { mix-blend-mode: multiply } #b { mix-blend-mode: screen }");
  EXPECT_EQ(found["a"], multiply);
  EXPECT_EQ(found["b"], screen);
  found = with(
      "g.ink > rect.x{mix-blend-mode:screen}.x{mix-blend-mode:multiply}svg g{isolation:isolate}");
  EXPECT_EQ(found["a"], screen) << "the more precise selector counts";
  EXPECT_EQ(found["g"], "isolation: isolate");
  found =
      with("<![CDATA[ .ink.layer{mix-blend-mode:multiply !important} #g{mix-blend-mode:screen}]]>");
  EXPECT_EQ(found["g"], multiply);
  found = styles(
      "<style>rect{mix-blend-mode:screen}</style>"
      "<rect id='a' style='mix-blend-mode:normal' x='10' y='25' width='100' height='30'/>");
  EXPECT_EQ(found["a"], "");
}

TEST_F(DrawingSvg, NamesBlendModesThatItCannotKeep) {
  Words words = deform(
      "<style>rect:first-child { mix-blend-mode: screen }</style>" + std::string(kBars), kEdit);
  EXPECT_THAT(expect_success(words).err, HasSubstr("rect:first-child"));
  words = deform(
      "<defs><g id='s'><rect style='mix-blend-mode:screen' x='10' y='25' width='100' "
      "height='30'/></g></defs><use href='#s'/>",
      kEdit);
  EXPECT_THAT(expect_success(words).err, HasSubstr("the blend modes of 1 elements"));
  EXPECT_THAT(expect_success(deform(kBars, kEdit)).err, Not(HasSubstr("left out")));
}

TEST_F(DrawingSvg, NamesThatCannotBeKeptAreNamed) {
  // To find out what paints what, each element gets an id, which changes this file.
  Words words = deform(
      "<style>rect:not([id]) { fill: none }</style>"
      "<rect id='a' x='10' y='25' width='100' height='30'/>"
      "<rect x='20' y='30' width='9' height='9'/>",
      kEdit);
  EXPECT_THAT(expect_success(words).err, HasSubstr("left out: ids, classes, groups, links"));
}

/// The matrix of the first gradient of the output.
std::vector<double> gradient_matrix(const std::string& svg) {
  const std::size_t at = svg.find("matrix(");
  std::istringstream text(svg.substr(at + 7));
  std::vector<double> numbers(6);
  for (double& number : numbers) text >> number;
  return numbers;
}

TEST_F(DrawingSvg, AGradientTurnsWithItsPath) {
  // The gradient goes across the square at the right, whose end turns by a quarter.
  const std::string edit =
      "edit:\n  - {select: {box: {min: [0, 0], max: [20, 80]}}, fix: true}\n"
      "  - {select: {box: {min: [84, 0], max: [120, 80]}}, rotate: 90}\n";
  const std::string bars =
      "<rect x='5' y='34' width='83' height='12'/>"
      "<rect x='86' y='26' width='28' height='28' fill='url(#p)'/>";
  const auto defined = [](const std::string& place) {
    return "<linearGradient id='p' " + place +
           "><stop offset='0' stop-color='#f00'/><stop offset='1' "
           "stop-color='#00f'/></linearGradient>";
  };
  for (const std::string& place :
       {std::string("x1='0' x2='1'"),
        std::string("gradientUnits='userSpaceOnUse' x1='30' x2='114'")}) {
    expect_success(deform(defined(place) + bars, edit));
    const std::vector<double> m = gradient_matrix(get("out.svg"));
    EXPECT_LT(std::abs(m[0]), 0.1 * std::abs(m[1])) << "it goes down: " << m[0] << " " << m[1];
    EXPECT_GT(m[1], 0);
  }
}

TEST_F(DrawingSvg, MoreDepthsThanLayersAreNamed) {
  const std::string edit =
      "edit:\n  - {select: {point: [15, 40]}, fix: true}\n"
      "  - {select: {point: [60, 40]}, fix: true}\n"
      "  - {select: {point: [105, 40]}, to: [30, 42]}\n";
  Words words = deform("<rect x='10' y='25' width='100' height='30'/>", edit);
  words[7] = "200";
  EXPECT_THAT(expect_success(words).err, Not(HasSubstr("depths")));
  words.emplace_back("depth.adjust=false");
  EXPECT_THAT(expect_success(words).err, HasSubstr("depths, and an SVG shows at most 64"));
}

}  // namespace
}  // namespace deformlab::test
