#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace deformlab {

/// The values of some properties of the elements of an SVG, from style sheets, styles of elements
/// and attributes, with the precedence of CSS. Selectors may name types, classes, ids and
/// ancestors: `rect`, `.a.b`, `#c`, `g.a > path`.
class StyleSheets {
 public:
  /// A declaration whose selector is not understood.
  struct Unread {
    std::string selector, property, value;
  };

  StyleSheets() = default;
  StyleSheets(const pugi::xml_node& root, std::vector<std::string> properties);

  /// The value that is declared for an element itself; empty without one.
  std::string value_of(std::string_view property, const pugi::xml_node& element) const;
  const std::vector<Unread>& unread() const { return unread_; }

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

  std::vector<std::string> properties_;
  std::vector<Rule> rules_;
  std::vector<Unread> unread_;
};

}  // namespace deformlab
