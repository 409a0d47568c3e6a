#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/subjects/experiment.h"

namespace deformlab {

/// Writes into `folder`: config.yaml (with every default), metrics.json, environment.json,
/// times.json (all seconds, so that the other files are the same bytes in every run), a trace of
/// each solve (trace.csv, or for a sweep trace_001.csv, trace_002.csv and so on), table.md for a
/// sweep, picture.png, and for an image sequence of an animation frames/0000.png and so on, and
/// movie.webp, which plays them.
void write_results(const Outcome& outcome, const std::filesystem::path& folder);

/// The names of the files that write_results writes for so many runs and so many pictures of a
/// sequence, relative to the folder.
std::vector<std::string> result_names(std::size_t runs, std::size_t frames);

/// The metrics of one run as JSON, for the flag --metrics.
std::string to_json(const Run& run);

/// Rewrites README.md of a folder of results. It has a picture, the claims and the table of each
/// experiment in the folder, in the order of names. A README.md without the mark of this page
/// belongs to somebody else: it stays, and a warning says so.
void write_gallery(const std::filesystem::path& results);

}  // namespace deformlab
