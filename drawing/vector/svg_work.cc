#include "drawing/vector/svg_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drawing/vector/style_sheets.h"
#include "drawing/vector/svg_values.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

constexpr std::array<const char*, 3> kMarkers{"marker-start", "marker-mid", "marker-end"};

/// The ids of these markers, which an element has or passes on to what is in it; empty for none.
using Markers = std::array<std::string, kMarkers.size()>;

/// How many numbers a corner takes at least, after a letter of a path. The flags of an arc may
/// stand in one number with what follows.
double numbers_of_corner(char letter) {
  switch (letter | 0x20) {
    case 'h':
    case 'v':
      return 1;
    case 's':
    case 'q':
      return 4;
    case 'a':
      return 5;
    case 'c':
      return 6;
    default:
      return 2;
  }
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_one_of(char c, std::string_view some) { return some.find(c) != some.npos; }

/// The corners of a path or a list of points, or a few more.
double corners_of(std::string_view text) {
  double corners = 2, numbers = 2;
  bool has_point = false;  // the number at hand
  char before = ' ';
  for (const char c : text) {
    const bool goes_on = is_digit(before) || is_one_of(before, ".eE+-");
    if (std::isalpha(static_cast<unsigned char>(c)) != 0 && !is_one_of(c, "eE")) {
      numbers = numbers_of_corner(c);
      ++corners;
    } else if ((is_digit(c) && !goes_on) || (c == '.' && (has_point || !goes_on)) ||
               (is_one_of(c, "+-") && !is_one_of(before, "eE"))) {
      corners += 1 / numbers;
      has_point = false;
    }
    has_point = has_point || c == '.';
    before = c;
  }
  return corners;
}

/// The ids that a value names, as `url(#a)` or `url('#a')`.
std::vector<std::string> targets(std::string_view value) {
  constexpr std::string_view kAround = " \t\r\n'\"", kEnd = " \t\r\n'\")";
  std::vector<std::string> ids;
  for (std::size_t at = value.find("url("); at != value.npos; at = value.find("url(")) {
    value.remove_prefix(at + 4);
    value.remove_prefix(std::min(value.find_first_not_of(kAround), value.size()));
    if (!value.starts_with('#')) continue;
    ids.emplace_back(value.substr(1, value.find_first_of(kEnd) - 1));
  }
  return ids;
}

/// Counts what the elements of a document draw, or a little more.
class Work {
 public:
  static constexpr int kDeepest = 1000;  // of elements in each other, or that name each other

  explicit Work(const pugi::xml_document& document)
      : sheets_(document, {"marker", kMarkers[0], kMarkers[1], kMarkers[2]}) {
    for (const auto& found : document.select_nodes("//*[@id]")) {
      by_id_.emplace(found.node().attribute("id").value(), found.node());
    }
  }

  double objects(const pugi::xml_node& node, const Markers& passed_on = {}) {
    const Deeper deeper(depth_);
    if (depth_ > kDeepest || ++visits_ > kMostVisits) return kEndless;
    const Markers markers = markers_of(node, passed_on);
    double count = 1 + drawn_markers(node, markers);
    for (const pugi::xml_node& child : node) count += objects(child, markers);
    if (local_name(node.name()) != "use") return count;
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const std::string_view name = attribute.name(), value = attribute.value();
      const bool refers = name == "href" || name.ends_with(":href");
      if (refers && value.starts_with('#')) count += named(std::string(value.substr(1)), markers);
    }
    return count;
  }

 private:
  // What is visited is also counted, except for markers that are compared and not chosen.
  static constexpr double kMostVisits = 10 * kMostSvgObjects;
  static constexpr double kEndless = std::numeric_limits<double>::infinity();

  struct Deeper {
    int& depth;
    explicit Deeper(int& counter) : depth(++counter) {}
    ~Deeper() { --depth; }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;
  };

  double drawn_markers(const pugi::xml_node& node, const Markers& markers) {
    const std::string_view name = local_name(node.name());
    if (name != "path" && name != "line" && name != "polyline" && name != "polygon") return 0;
    double count = marker(markers[0]) + marker(markers[2]);
    if (markers[1].empty()) return count;
    return count +
           corners_of(node.attribute(name == "path" ? "d" : "points").value()) * marker(markers[1]);
  }

  // Of several markers that an element may have, the one that draws most.
  Markers markers_of(const pugi::xml_node& node, const Markers& passed_on) {
    Markers markers = passed_on;
    if (node.type() != pugi::node_element) return markers;
    const std::string shared = sheets_.value_of("marker", node);
    for (std::size_t i = 0; i < kMarkers.size(); ++i) {
      const std::string own = sheets_.value_of(kMarkers[i], node);
      std::vector<std::string> ids = targets(own + " " + shared);
      for (const StyleSheets::Unread& unread : sheets_.unread()) {
        if (unread.property != "marker" && unread.property != kMarkers[i]) continue;
        std::ranges::move(targets(unread.value), std::back_inserter(ids));
      }
      const bool is_declared = !own.empty() || !shared.empty();
      if (is_declared && own != "inherit" && shared != "inherit") markers[i] = "";
      for (const std::string& id : ids) {
        if (marker(id) > marker(markers[i])) markers[i] = id;
      }
    }
    return markers;
  }

  // A marker inherits from where it stands, and not from what it is drawn on.
  double marker(const std::string& id) {
    const auto found = by_id_.find(id);
    if (found == by_id_.end()) return 0;
    const Deeper deeper(depth_);
    if (depth_ > kDeepest) return kEndless;
    const auto [place, is_new] = places_.try_emplace(id);
    if (is_new) {
      std::vector<pugi::xml_node> around;
      for (auto at = found->second.parent(); at; at = at.parent()) around.push_back(at);
      Markers passed_on;
      while (!around.empty()) {
        passed_on = markers_of(around.back(), passed_on);
        around.pop_back();
      }
      place->second = passed_on;
    }
    return named(id, place->second);
  }

  // An element that names itself counts as nothing.
  double named(const std::string& id, const Markers& passed_on) {
    const auto found = by_id_.find(id);
    if (found == by_id_.end()) return 0;
    const auto [known, is_new] = counts_.try_emplace({id, passed_on}, 0);
    if (is_new) known->second = objects(found->second, passed_on);
    return known->second;
  }

  StyleSheets sheets_;
  std::map<std::string, pugi::xml_node> by_id_;
  std::map<std::pair<std::string, Markers>, double> counts_;
  std::map<std::string, Markers> places_;
  double visits_ = 0;
  int depth_ = 0;
};

}  // namespace

void check_svg_work(const pugi::xml_document& document, const std::filesystem::path& name) {
  const double objects = Work(document).objects(document);
  if (!(objects <= kMostSvgObjects)) {
    cannot_read(name,
                fmt::format("it draws about {:.3g} objects with all 'use' and markers; at most "
                            "{} are allowed, so simplify the drawing",
                            objects, kMostSvgObjects));
  }
  const auto stops = static_cast<double>(document.select_nodes("//*[local-name()='stop']").size());
  if (stops <= kMostSvgStops) return;
  cannot_read(name, fmt::format("its gradients have {} stops; at most {} are allowed, so simplify "
                                "the drawing",
                                stops, kMostSvgStops));
}

}  // namespace deformlab
