#pragma once

#include <string_view>

namespace deformlab {

/// The present name of a key or a value of a config that was called `old_name` in earlier versions;
/// empty for other names. A key that has moved is found by its dotted path.
std::string_view renamed(std::string_view old_name);

}  // namespace deformlab
