#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config_node.h"

namespace deformlab {

/// One value set over those of a config: `graph.nodes=425`, `edit.0.by=[0, 0, 1]`.
struct Override {
  std::string key;               ///< names (and indices of lists), joined by dots
  std::string value;             ///< YAML
  std::filesystem::path folder;  ///< what a relative path in the value is relative to

  std::string text() const { return key + "=" + value; }
};

/// Most runs that a sweep may ask for.
inline constexpr std::size_t kMaxSweepRuns = 10'000;

/// Splits `key=value` as a user types it. Throws InputError where there is no '=', the key is empty
/// or one of its names is.
Override parse_override(std::string_view text);

/// Sets the value in the config. Missing maps on the way are made: whether their names are known is
/// found out when the config is read, and the message then names the override. Throws InputError
/// where the value is not YAML, an index is outside its list, or a scalar stands in the way.
void apply_override(ConfigNode& root, const Override& change);

/// The cartesian product of a `sweep:` block, which maps dotted keys to lists of values: for each
/// run its overrides, in file order, the first key varying slowest; a map in such a list sets
/// each of its keys and leaves the others as they are. No block (a null node): one run
/// without overrides. Throws InputError where the block is not such a map, a list is empty, or
/// there are more than kMaxSweepRuns runs.
std::vector<std::vector<Override>> expand_sweep(const ConfigNode& sweep);

}  // namespace deformlab
