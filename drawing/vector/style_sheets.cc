#include "drawing/vector/style_sheets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "drawing/vector/svg_values.h"
#include "geometry/core/text.h"

namespace deformlab {
namespace {

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

StyleSheets::StyleSheets(const pugi::xml_node& root, std::vector<std::string> properties)
    : properties_(std::move(properties)) {
  Sheets sheets;
  pugi::xml_node(root).traverse(sheets);
  for (std::string& text : sheets.texts) read_sheet(without_comments(std::move(text)));
}

void StyleSheets::read_sheet(const std::string& text) {
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

void StyleSheets::add_rules(std::string_view selector, std::string_view declarations) {
  const auto style = style_of(declarations);
  for (const std::string& property : properties_) {
    const bool is_block = selector.starts_with('@');  // its declarations are in further rules
    const auto found = style.find(property);
    const bool declares =
        is_block ? declarations.find(property) != declarations.npos : found != style.end();
    if (!declares) continue;
    Rule rule;
    if (is_block || !parse(selector, rule)) {
      unread_.push_back(
          {std::string(selector), property, std::string(is_block ? declarations : found->second)});
      continue;
    }
    const auto [value, important] = value_and_weight(found->second);
    rule.property = property;
    rule.value = value;
    rule.weight += important ? kImportant : 0;
    rules_.push_back(std::move(rule));
  }
}

bool StyleSheets::parse(std::string_view selector, Rule& rule) {
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

bool StyleSheets::Step::matches(const pugi::xml_node& element) const {
  return element && (type.empty() || type == local_name(element.name())) &&
         (id.empty() || id == element.attribute("id").value()) &&
         std::ranges::all_of(classes, [&](const auto& name) { return has_class(element, name); });
}

bool StyleSheets::matches(const Rule& rule, const pugi::xml_node& element) {
  if (!rule.steps.back().matches(element)) return false;
  pugi::xml_node at = element;
  for (auto step = std::next(rule.steps.rbegin()); step != rule.steps.rend(); ++step) {
    at = at.parent();
    while (at && !step->is_parent && !step->matches(at)) at = at.parent();
    if (!step->matches(at)) return false;
  }
  return true;
}

std::string StyleSheets::value_of(std::string_view property, const pugi::xml_node& element) const {
  std::string chosen = element.attribute(std::string(property).c_str()).value();
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

}  // namespace deformlab
