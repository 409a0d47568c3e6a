#include "experiments/subjects/drawing/output_page.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "experiments/config/config.h"
#include "experiments/config/suggest.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr double kFarthest = 1e6;  // [pixel]
constexpr const char* kExpected =
    "grow, keep, or a box [x0, y0, x1, y1] or {min: [x0, y0], max: [x1, y1]}";

// The four numbers of a box in either form.
std::vector<double> numbers_of(const ConfigNode& node, const std::string& name) {
  std::vector<double> numbers;
  if (node.kind == ConfigNode::Kind::kList && node.children.size() == 4) {
    read_value(node, name, numbers);
    return numbers;
  }
  if (node.kind != ConfigNode::Kind::kMap) throw_wrong_value(node, name, kExpected);
  check_keys(node, {"min", "max"}, "key", name + ".");
  for (const char* corner : {"min", "max"}) {
    const ConfigNode* point = node.find(corner);
    if (!point) throw_wrong_value(node, name, kExpected);
    std::vector<double> coordinates;
    const std::string its = fmt::format("{}.{}", name, corner);
    if (point->kind != ConfigNode::Kind::kList || point->children.size() != 2) {
      throw_wrong_value(*point, its, "two coordinates [x, y]");
    }
    read_value(*point, its, coordinates);
    numbers.insert(numbers.end(), coordinates.begin(), coordinates.end());
  }
  return numbers;
}

Page box_of(const ConfigNode& node, const std::string& name) {
  const std::vector<double> n = numbers_of(node, name);
  const auto require = [&](bool good, const char* what) {
    if (good) return;
    throw InputError(fmt::format("wrong value for {} ({}): expected a box {}, found {}",
                                 quote(name), node.where(), what, to_yaml_line(to_node(n))));
  };
  for (const double number : n) {
    require(std::abs(number) <= kFarthest, "whose coordinates lie between -1000000 and 1000000");
  }
  require(n[0] < n[2] && n[1] < n[3], "with x0 less than x1, and y0 less than y1 (y points down)");
  return {Eigen::Vector2d(n[0], n[1]), Eigen::Vector2d(n[2], n[3])};
}

}  // namespace

void read_value(const ConfigNode& node, const std::string& name, OutputPage& page) {
  if (node.kind == ConfigNode::Kind::kList || node.kind == ConfigNode::Kind::kMap) {
    page = {.rule = PageRule::kGrow, .box = box_of(node, name)};
    return;
  }
  const std::optional<PageRule> rule = value_of<PageRule>(node.text);
  if (!rule) throw_wrong_value(node, name, kExpected);
  page = {.rule = *rule, .box = {}};
}

ConfigNode to_node(const OutputPage& page) {
  if (!page.box) return to_node(page.rule);
  const Eigen::Vector2d &a = page.box->min(), &b = page.box->max();
  return to_node(std::vector<double>{a.x(), a.y(), b.x(), b.y()});
}

}  // namespace deformlab
