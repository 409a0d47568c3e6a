#include "drawing/vector/blend_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "drawing/vector/svg_values.h"

namespace deformlab {
namespace {

constexpr const char* kProperties[] = {"mix-blend-mode", "isolation"};
constexpr int kImportant = 1'000'000'000, kOwnStyle = 100'000'000;  // weights of declarations

bool is_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ||
         static_cast<unsigned char>(c) > 127;
}

/// Removes a name from the front of the text.
std::string take_name(std::string_view& text) {
  const auto end = std::ranges::find_if_not(text, is_name);
  std::string name(text.begin(), end);
  text.remove_prefix(name.size());
  return name;
}

std::string without_comments(std::string text) {
  for (std::size_t begin = text.find("/*"); begin != text.npos; begin = text.find("/*")) {
    const std::size_t end = text.find("*/", begin + 2);
    text.replace(begin, end == text.npos ? text.npos : end + 2 - begin, " ");
  }
  return text;
}

/// The value without `!important`, and whether it had that.
std::pair<std::string, bool> value_and_weight(std::string_view value) {
  const std::size_t mark = value.find('!');
  return {std::string(trimmed(value.substr(0, mark))), mark != value.npos};
}

bool has_class(const pugi::xml_node& element, const std::string& name) {
  std::string all = element.attribute("class").value();
  std::ranges::replace_if(
      all, [](unsigned char c) { return std::isspace(c) != 0; }, ' ');
  return fmt::format(" {} ", all).find(fmt::format(" {} ", name)) != std::string::npos;
}

struct Sheets : pugi::xml_tree_walker {
  std::vector<std::string> texts;

  bool for_each(pugi::xml_node& node) override {
    if (local_name(node.name()) != "style") return true;
    std::string& text = texts.emplace_back();
    for (const pugi::xml_node& child : node.children())
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
        text += child.value();
    return true;
  }
};

}  // namespace

BlendModes::BlendModes(const pugi::xml_node& root) {
  Sheets sheets;
  pugi::xml_node(root).traverse(sheets);
  for (std::string& text : sheets.texts) read_sheet(without_comments(std::move(text)));
}

void BlendModes::read_sheet(const std::string& text) {
  std::string_view rest = text;
  while (true) {
    const std::size_t open = rest.find('{');
    if (open == rest.npos) return;
    std::string_view selectors = rest.substr(0, open);
    selectors.remove_prefix(std::min(selectors.rfind(';') + 1, selectors.size()));  // @import …;
    std::size_t close = open;
    for (int depth = 0; close < rest.size(); ++close) {
      depth += rest[close] == '{' ? 1 : rest[close] == '}' ? -1 : 0;
      if (depth == 0) break;
    }
    const std::string_view body =
        rest.substr(open + 1, std::min(close, rest.size()) - std::min(open + 1, close));
    while (!selectors.empty()) {
      const std::size_t comma = std::min(selectors.find(','), selectors.size());
      add_rules(trimmed(selectors.substr(0, comma)), body);
      selectors.remove_prefix(std::min(comma + 1, selectors.size()));
    }
    rest.remove_prefix(std::min(close + 1, rest.size()));
  }
}

void BlendModes::add_rules(std::string_view selector, std::string_view declarations) {
  const auto style = style_of(declarations);
  for (const char* property : kProperties) {
    Rule rule;
    if (selector.starts_with('@') || !parse(selector, rule)) {
      if (declarations.find(property) != declarations.npos) unread_.emplace_back(selector);
      continue;
    }
    const auto found = style.find(property);
    if (found == style.end()) continue;
    const auto [value, important] = value_and_weight(found->second);
    rule.property = property;
    rule.value = value;
    rule.weight += important ? kImportant : 0;
    rules_.push_back(std::move(rule));
  }
}

bool BlendModes::parse(std::string_view selector, Rule& rule) {
  constexpr int kId = 10'000, kClass = 100, kType = 1;
  while (!(selector = trimmed(selector)).empty()) {
    if (selector.front() == '>') {
      if (rule.steps.empty()) return false;
      rule.steps.back().is_parent = true;
      selector = trimmed(selector.substr(1));
    }
    Step& step = rule.steps.emplace_back();
    const std::size_t before = selector.size();
    if (selector.starts_with('*')) selector.remove_prefix(1);
    step.type = take_name(selector);
    rule.weight += step.type.empty() ? 0 : kType;
    while (selector.starts_with('.') || selector.starts_with('#')) {
      const bool is_class = selector.front() == '.';
      selector.remove_prefix(1);
      const std::string name = take_name(selector);
      if (name.empty()) return false;
      is_class ? step.classes.push_back(name) : void(step.id = name);
      rule.weight += is_class ? kClass : kId;
    }
    if (selector.size() == before) return false;  // a selector of another kind, such as [a] or :b
    const bool ends =
        selector.empty() || selector.front() == '>' || trimmed(selector).size() < selector.size();
    if (!ends) return false;
  }
  return !rule.steps.empty() && !rule.steps.back().is_parent;
}

bool BlendModes::Step::matches(const pugi::xml_node& element) const {
  return element && (type.empty() || type == local_name(element.name())) &&
         (id.empty() || id == element.attribute("id").value()) &&
         std::ranges::all_of(classes, [&](const auto& name) { return has_class(element, name); });
}

bool BlendModes::matches(const Rule& rule, const pugi::xml_node& element) {
  if (!rule.steps.back().matches(element)) return false;
  pugi::xml_node at = element;
  for (auto step = std::next(rule.steps.rbegin()); step != rule.steps.rend(); ++step) {
    at = at.parent();
    while (at && !step->is_parent && !step->matches(at)) at = at.parent();
    if (!step->matches(at)) return false;
  }
  return true;
}

std::string BlendModes::value_of(const char* property, const pugi::xml_node& element) const {
  std::string chosen = element.attribute(property).value();
  int greatest = -1;
  const auto take = [&](const std::string& value, int weight) {
    if (weight < greatest) return;
    chosen = value;
    greatest = weight;
  };
  for (const Rule& rule : rules_)
    if (rule.property == property && matches(rule, element)) take(rule.value, rule.weight);
  const auto style = style_of(element.attribute("style").value());
  if (const auto found = style.find(property); found != style.end()) {
    const auto [value, important] = value_and_weight(found->second);
    take(value, kOwnStyle + (important ? kImportant : 0));
  }
  return chosen;
}

std::string BlendModes::of(const pugi::xml_node& element) const {
  std::vector<std::string> parts;
  for (const char* property : kProperties) {
    const std::string value = value_of(property, element);
    const bool usual = value.empty() || value == "normal" || value == "auto";
    if (!usual) parts.push_back(fmt::format("{}: {}", property, value));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace deformlab
