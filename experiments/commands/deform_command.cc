#include <algorithm>

#include "experiments/commands/commands.h"
#include "experiments/commands/one_run.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

// Two keys have short names.
std::string full_name(const std::string& override) {
  const bool is_short = override.starts_with("path=") || override.starts_with("pictured=");
  return is_short ? "animation." + override : override;
}

}  // namespace

int deform_command(const std::vector<std::string>& arguments, CommandLine line) {
  if (arguments.empty() || line.edit.empty() || line.out.empty()) {
    throw InputError(
        "deform needs a shape, an edit and an output: "
        "deformlab deform SHAPE --edit EDIT.yaml --out OUT [key=value]…");
  }
  line.input = arguments.front();
  line.overrides.assign(arguments.begin() + 1, arguments.end());
  std::error_code ignored;  // a config's file may be elsewhere, but not that of a command
  if (!std::filesystem::exists(line.input, ignored)) cannot_read(line.input, "no such file");
  return run_once(kind_of(line, ""), line, "deformed");
}

int animate_command(const std::vector<std::string>& overrides, const std::string& frames,
                    const std::string& particles, CommandLine line) {
  if (frames.empty() == particles.empty() || line.edit.empty() || line.out.empty()) {
    throw InputError(
        "animate needs frames or particles, an edit and an output: deformlab animate --frames "
        "'horse-%03d.obj' --edit EDIT.yaml --out 'edited-%03d.obj' [key=value]…, or with "
        "--particles cache.csv instead");
  }
  line.input = frames.empty() ? particles : frames;
  std::ranges::transform(overrides, std::back_inserter(line.overrides), full_name);
  return run_once(kind_of(line, frames.empty() ? "particles" : "frames"), line, "edited");
}

}  // namespace deformlab
