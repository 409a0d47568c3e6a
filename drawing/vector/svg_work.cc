#include "drawing/vector/svg_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "geometry/core/files.h"

namespace deformlab {
namespace {

/// Counts what the elements of a document draw.
class Work {
 public:
  static constexpr int kDeepest = 1000;  // of elements in each other, or that name each other

  explicit Work(const pugi::xml_document& document) {
    for (const auto& found : document.select_nodes("//*[@id]")) {
      by_id_.emplace(found.node().attribute("id").value(), found.node());
    }
  }

  double objects(const pugi::xml_node& node) {
    if (++depth_ > kDeepest) return std::numeric_limits<double>::infinity();
    double count = 1;
    for (const pugi::xml_node& child : node) count += objects(child);
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const std::string_view name = attribute.name(), value = attribute.value();
      const bool refers = name == "href" || name == "xlink:href";
      if (refers && std::string_view(node.name()).ends_with("use") && value.starts_with('#')) {
        count += named(std::string(value.substr(1)));
      } else if (name.starts_with("marker")) {
        count += corners(node) * named(target(value));
      } else if (name == "style" && value.find("marker") != std::string_view::npos) {
        count += corners(node) * named(target(value.substr(value.find("marker"))));
      }
    }
    --depth_;
    return count;
  }

 private:
  static std::string target(std::string_view value) {
    const std::size_t begin = value.find("url(#");
    if (begin == std::string_view::npos) return "";
    value.remove_prefix(begin + 5);
    return std::string(value.substr(0, value.find(')')));
  }

  // About as many as a path has: two numbers make a corner, and a letter may begin one.
  static double corners(const pugi::xml_node& node) {
    const std::string_view path = *node.attribute("d").value() != 0
                                      ? node.attribute("d").value()
                                      : node.attribute("points").value();
    const auto separates = [](char c) {
      return std::string_view(" ,\t\r\n").find(c) != std::string_view::npos;
    };
    return static_cast<double>(std::ranges::count_if(path, separates)) / 2 + 2;
  }

  // An element that names itself counts as nothing.
  double named(const std::string& id) {
    const auto known = of_id_.find(id);
    if (known != of_id_.end()) return known->second;
    const auto found = by_id_.find(id);
    if (found == by_id_.end()) return 0;
    of_id_[id] = 0;
    const double count = objects(found->second);
    return of_id_[id] = count;
  }

  std::map<std::string, pugi::xml_node> by_id_;
  std::map<std::string, double> of_id_;
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
