#include <algorithm>

#include "experiments/commands/commands.h"
#include "experiments/commands/one_run.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

// The keys of the edit's file, and some others, have short names.
std::string full_name(const std::string& override) {
  for (const char* name : {"path=", "pictured=", "fps=", "loop=", "interpolation="}) {
    if (override.starts_with(name)) return "animation." + override;
  }
  return override;
}

bool is_override(const std::string& word) { return word.find('=') != std::string::npos; }

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

int animate_command(const std::vector<std::string>& arguments, const std::string& frames,
                    const std::string& particles, CommandLine line) {
  const bool has_drawing = !arguments.empty() && !is_override(arguments.front());
  const int inputs = has_drawing + !frames.empty() + !particles.empty();
  if (inputs != 1 || line.edit.empty() || line.out.empty()) {
    throw InputError(
        "animate needs a drawing, or frames or particles, and an edit and an output: deformlab "
        "animate DRAWING --edit KEYS.yaml --out 'frame-%03d.png' [key=value]…, or with --frames "
        "'horse-%03d.obj' or --particles cache.csv instead of the drawing");
  }
  std::transform(arguments.begin() + has_drawing, arguments.end(),
                 std::back_inserter(line.overrides), full_name);
  if (has_drawing) {
    line.input = arguments.front();
    check_readable(line.input);
    return run_once(kind_of(line, "drawing"), line, "animated");
  }
  line.input = frames.empty() ? particles : frames;
  return run_once(kind_of(line, frames.empty() ? "particles" : "frames"), line, "edited");
}

}  // namespace deformlab
