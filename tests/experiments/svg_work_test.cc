#include "tests/support/program.h"

namespace deformlab::test {
namespace {

const std::string kBegin =
    R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" )"
    R"(width="200" height="200">)";

/// Short drawings that would take minutes.
class SvgWork : public Program {
 protected:
  void expect_too_much(const std::string& inside, const std::string& says) const {
    put("a.svg", kBegin + inside + "</svg>");
    put("bend.yaml", "edit:\n  - {select: {point: [20, 20]}, fix: true}\n");
    expect_refused({"deform", "a.svg", "--edit", "bend.yaml", "--out", "o.svg"}, {"'a.svg'", says});
  }
};

TEST_F(SvgWork, OfNestedUsesIsBounded) {
  std::string text = R"(<path id="a0" d="M10 10h100v100h-100z"/>)";
  for (int i = 1; i < 30; ++i) {
    const std::string use = "<use xlink:href=\"#a" + std::to_string(i - 1) + "\"/>";
    text += "<g id=\"a" + std::to_string(i) + "\">" + use + use + use + use + "</g>";
  }
  expect_too_much("<defs>" + text + "</defs><use xlink:href=\"#a29\"/>", "objects");
}

TEST_F(SvgWork, OfMarkersIsBounded) {
  std::string path = "M10 10";
  for (int i = 0; i < 60'000; ++i) path += " L" + std::to_string(i % 99) + " 5";
  const std::string marker =
      R"(<marker id="m" markerWidth="5" markerHeight="5"><path d="M0 0h3v3z"/></marker>)";
  expect_too_much(marker + "<path marker-mid=\"url(#m)\" d=\"" + path + "\"/>", "objects");
}

TEST_F(SvgWork, OfGradientsIsBounded) {
  std::string stops;
  for (int i = 0; i < 10'001; ++i) stops += R"(<stop offset="0.5" stop-color="#123456"/>)";
  expect_too_much("<linearGradient id=\"g\">" + stops +
                      R"(</linearGradient><path fill='url(#g)' d="M10 10h100v100h-100z"/>)",
                  "10001 stops");
}

}  // namespace
}  // namespace deformlab::test
