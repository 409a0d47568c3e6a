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

/// A path of 60 corners, and the marker m of 2,000 objects.
std::string marked_path(const std::string& attributes) {
  std::string path = "M10 10", objects;
  for (int i = 0; i < 30; ++i) path += "h" + std::to_string(i % 2 == 0 ? 90 : -90) + "v4";
  for (int i = 0; i < 2000; ++i) objects += R"(<rect width="3" height="3"/>)";
  return R"(<marker id="m" markerWidth="5" markerHeight="5">)" + objects +
         "</marker><path id=\"p\" " + attributes + " d=\"" + path + "\"/>";
}

TEST_F(SvgWork, OfMarkersIsBounded) {
  const std::string path = marked_path("");
  expect_too_much(marked_path("marker-mid=\"url(#m)\""), "objects");
  expect_too_much(marked_path("style=\"marker:url('#m')\""), "objects");
  expect_too_much("<style>path{marker-mid:url(#m)}</style>" + path, "objects");
  expect_too_much("<style>#p:nth-child(2){marker-mid:url(#m)}</style>" + path, "objects");
  expect_too_much("<style>@media all{path{marker-mid:url(#m)}}</style>" + path, "objects");
  expect_too_much("<style>.a{marker:url(#m)}</style><g class=\"a\">" + path + "</g>", "objects");
  expect_too_much("<defs>" + path + "</defs><g marker-mid=\"url(#m)\"><use href=\"#p\"/></g>",
                  "objects");
}

TEST_F(SvgWork, OfMarkersThatAreNotDrawnIsNotCounted) {
  put("bend.yaml", "edit:\n  - {select: {point: [12, 12]}, fix: true}\n");
  for (const std::string sheet :
       {"path{marker-start:url(#m);marker-end:url(#m)}", "g{marker-mid:url(#m)}",
        "path{marker-mid:url(#m)}path{marker-mid:none}", ".other{marker:url(#m)}"}) {
    put("a.svg", kBegin + "<style>" + sheet + "</style>" + marked_path("") + "</svg>");
    expect_success({"deform", "a.svg", "--edit", "bend.yaml", "--out", "o.png"});
  }
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
