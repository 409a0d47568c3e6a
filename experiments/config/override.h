#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/config/config_node.h"

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

/// One run of a sweep: what it is known by, and what it sets over the config.
struct SweptRun {
  std::vector<std::pair<std::string, std::string>> settings;  ///< key of the sweep, value as YAML
  std::vector<Override> overrides;
};

/// The keys of the config that a sweep sets, where they stand in it.
std::vector<const ConfigNode*> swept_keys(const ConfigNode& sweep);

/// The cartesian product of a `sweep:` block, in file order, the first key varying slowest. A
/// dotted key maps to a list of values; a map in such a list sets each of its keys and leaves the
/// others as they are. A word of one's own maps names to maps of dotted keys, which then are set
/// together: `row: {small: {graph.nodes: 30, edit: […]}, large: {…}}`. No block (a null node): one
/// run that sets nothing. Throws InputError where the block is not such a map, a list is empty, or
/// there are more than kMaxSweepRuns runs.
std::vector<SweptRun> expand_sweep(const ConfigNode& sweep);

}  // namespace deformlab
