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
  std::filesystem::path folder;  ///< where relative paths in the value begin

  std::string text() const { return key + "=" + value; }
};

/// The largest number of runs of a sweep.
inline constexpr std::size_t kMaxSweepRuns = 10'000;

/// Splits `key=value` as a user types it. Throws InputError if there is no '=', or if the key or
/// one of its names is empty.
Override parse_override(std::string_view text);

/// Sets the value in the config, and makes missing maps on the path to it. Their names are checked
/// when the config is read, and messages then name the override. Throws InputError if the value is
/// not YAML, if an index is outside its list, or if there is a scalar on the path.
void apply_override(ConfigNode& root, const Override& change);

/// One run of a sweep: its settings, for labels and claims, and what it sets in the config.
struct SweptRun {
  std::vector<std::pair<std::string, std::string>> settings;  ///< key of the sweep, value as YAML
  std::vector<Override> overrides;
};

/// The nodes of a sweep whose keys are those that it sets in the config.
std::vector<const ConfigNode*> swept_keys(const ConfigNode& sweep);

/// The cartesian product of a `sweep:` block, in file order. The first key varies slowest. A dotted
/// key has a list of values. A map in such a list sets each of its keys and does not change others.
/// Any other word maps names to maps of dotted keys that are set together:
/// `row: {small: {graph.nodes: 30, edit: […]}, large: {…}}`. Without a block (a null node), there
/// is one run that sets nothing. Throws InputError if the block is not such a map, if a list is
/// empty, or if there are more than kMaxSweepRuns runs.
std::vector<SweptRun> expand_sweep(const ConfigNode& sweep);

}  // namespace deformlab
