#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace deformlab {

/// How the elements of an SVG are blended with what is behind them: `mix-blend-mode` and
/// `isolation`, from style sheets, styles of elements and attributes, with the precedence of CSS.
/// Selectors may name types, classes, ids and ancestors: `rect`, `.a.b`, `#c`, `g.a > path`.
class BlendModes {
 public:
  BlendModes() = default;
  explicit BlendModes(const pugi::xml_node& root);

  /// The style of an element as text, such as `mix-blend-mode: multiply`; empty for the usual one.
  std::string of(const pugi::xml_node& element) const;
  /// The rules about blending that are not understood, by their selectors.
  const std::vector<std::string>& unread() const { return unread_; }

 private:
  /// One element of a selector, such as `g.a`.
  struct Step {
    std::string type, id;
    std::vector<std::string> classes;
    bool is_parent = false;  ///< of the next step's element, and not any ancestor of it

    bool matches(const pugi::xml_node& element) const;
  };
  struct Rule {
    std::vector<Step> steps;
    std::string property, value;
    int weight = 0;  ///< of its selector; the last one of the greatest weight counts
  };

  void read_sheet(const std::string& text);
  void add_rules(std::string_view selector, std::string_view declarations);
  static bool parse(std::string_view selector, Rule& rule);
  static bool matches(const Rule& rule, const pugi::xml_node& element);
  std::string value_of(const char* property, const pugi::xml_node& element) const;

  std::vector<Rule> rules_;
  std::vector<std::string> unread_;
};

}  // namespace deformlab
