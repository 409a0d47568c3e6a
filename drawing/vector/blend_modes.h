#pragma once

#include <pugixml.hpp>
#include <string>
#include <vector>

#include "drawing/vector/style_sheets.h"

namespace deformlab {

/// How the elements of an SVG are blended with what is behind them: `mix-blend-mode` and
/// `isolation`, from wherever StyleSheets finds them.
class BlendModes {
 public:
  BlendModes() = default;
  explicit BlendModes(const pugi::xml_node& root);

  /// The style of an element as text, such as `mix-blend-mode: multiply`; empty for the usual one.
  std::string of(const pugi::xml_node& element) const;
  /// The rules about blending that are not understood, by their selectors.
  std::vector<std::string> unread() const;

 private:
  StyleSheets sheets_;
};

}  // namespace deformlab
