#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/subjects/subject.h"

namespace deformlab {

/// `deformlab run CONFIG… [key=value]… [--out DIR]`: runs each config, prints its claims, writes
/// DIR/<config>/ and rewrites DIR/README.md. Returns 1 if a claim falls short, else 0.
int run_command(const std::vector<std::string>& arguments, const std::filesystem::path& out);

/// `deformlab deform FILE --edit EDIT.yaml --out OUT [key=value]…`: one run of a shape or a drawing
/// that writes its result. `line` has the values of flags. Returns 1 if the solver could not take a
/// step; then nothing is written.
int deform_command(const std::vector<std::string>& arguments, CommandLine line);

/// `deformlab animate DRAWING --edit KEYS.yaml --out PATTERN [key=value]…`, or with `--frames
/// PATTERN` instead of the drawing, or with `--particles CACHE.csv` and an --out of one file: one
/// run of an animation that writes its result. Returns 1 if the solver could not take a step.
int animate_command(const std::vector<std::string>& arguments, const std::string& frames,
                    const std::string& particles, CommandLine line);

/// What `deformlab help`, `deformlab list` and `deformlab version` print.
std::string help_text();
std::string list_text();
std::string version_text();

}  // namespace deformlab
