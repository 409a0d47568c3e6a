#include "drawing/vector/blend_modes.h"

#include <fmt/format.h>

namespace deformlab {
namespace {

constexpr const char* kProperties[] = {"mix-blend-mode", "isolation"};

}  // namespace

BlendModes::BlendModes(const pugi::xml_node& root)
    : sheets_(root, {std::begin(kProperties), std::end(kProperties)}) {}

std::vector<std::string> BlendModes::unread() const {
  std::vector<std::string> selectors;
  for (const StyleSheets::Unread& unread : sheets_.unread()) selectors.push_back(unread.selector);
  return selectors;
}

std::string BlendModes::of(const pugi::xml_node& element) const {
  std::vector<std::string> parts;
  for (const char* property : kProperties) {
    const std::string value = sheets_.value_of(property, element);
    const bool usual = value.empty() || value == "normal" || value == "auto";
    if (!usual) parts.push_back(fmt::format("{}: {}", property, value));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace deformlab
