#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "experiments/config/config_node.h"

namespace deformlab {

inline constexpr std::size_t kMaxConfigValues = 1'000'000;  ///< with all aliases expanded
inline constexpr std::size_t kMaxConfigBytes = std::size_t{32} << 20;  ///< the same

/// Where the first bytes are that are not UTF-8, or npos.
std::size_t find_invalid_utf8(std::string_view text);

/// Walks over a YAML text without building a tree. Throws InputError (with the line) where it is
/// not UTF-8, where a second document begins, and as soon as its values or their bytes become too
/// many with all aliases expanded. Throws YAML::Exception where it is not YAML.
void check_yaml(const std::string& text, std::shared_ptr<const ConfigSource> source);

}  // namespace deformlab
