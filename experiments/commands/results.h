#pragma once

#include <filesystem>
#include <string>

#include "experiments/subjects/experiment.h"

namespace deformlab {

/// Writes into `folder`: config.yaml (with every default), metrics.json, environment.json,
/// times.json (all seconds; the other files are the same bytes in every run), a trace of each solve
/// (trace.csv, or for a sweep trace_001.csv, trace_002.csv and so on), for a sweep table.md,
/// picture.png, and for an image sequence of an animation frames/0000.png and so on.
void write_results(const Outcome& outcome, const std::filesystem::path& folder);

/// Whether a folder of results may have a file of this name from one run of its config and not from
/// the next.
bool is_result(const std::filesystem::path& name);

/// The metrics of one run as JSON, for the flag --metrics.
std::string to_json(const Run& run);

/// Rewrites README.md of a results folder from what lies in it: a picture, the claims and the table
/// of each experiment, in order of their names.
void write_gallery(const std::filesystem::path& results);

}  // namespace deformlab
