#pragma once

#include <filesystem>
#include <pugixml.hpp>

namespace deformlab {

inline constexpr double kMostSvgObjects = 50'000;  ///< with all `use` and markers expanded
inline constexpr double kMostSvgStops = 10'000;    ///< of all gradients together

/// Throws InputError where an SVG draws so many objects, or has so many stops of gradients, that it
/// would take minutes. A short text can draw billions, because a `use` may name another one.
void check_svg_work(const pugi::xml_document& document, const std::filesystem::path& name);

}  // namespace deformlab
