#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/benchmarks/ab_runner.h"

namespace deformlab {

/// A Markdown table of ratios, with a row for each scenario and a column for each size, and a table
/// of all figures.
std::string to_markdown(const std::vector<Measurement>& all);

/// The same as JSON, with every time that was measured.
nlohmann::ordered_json to_json(const std::vector<Measurement>& all);

/// The environment as a Markdown list. It begins with a warning if the tree was dirty.
std::string environment_markdown();

}  // namespace deformlab
