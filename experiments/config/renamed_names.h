#pragma once

#include <string_view>

namespace deformlab {

/// The name that a key or a value of a config has today, where `old_name` is one that it had in
/// earlier versions; empty for other names. A key that has moved is found by its dotted path.
std::string_view renamed(std::string_view old_name);

}  // namespace deformlab
