#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/subjects/shape/edit.h"

namespace deformlab {

/// Reads a file with one index in each line. Blank lines are skipped. `where` is what messages call
/// the entry. Throws InputError (naming the line) for anything else.
std::vector<int> read_indices(const std::filesystem::path& path, const std::string& where);

/// Reads a file of targets. Each line is a handle and its target, as numbers that commas,
/// semicolons or blanks separate: the index of a vertex, or a place of as many coordinates as there
/// are dimensions, and then the target. A line of names may come first. Blank lines and lines that
/// begin with # are skipped. Throws InputError (naming the line) for anything else, and for a file
/// without targets.
std::vector<ListedTarget> read_targets(const std::filesystem::path& path, int dimension,
                                       const std::string& where);

}  // namespace deformlab
