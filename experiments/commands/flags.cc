#include "experiments/commands/flags.h"

#include <fmt/format.h>
#include <gflags/gflags.h>

#include <algorithm>

#include "experiments/config/suggest.h"
#include "geometry/core/error.h"
#include "geometry/graph/deformation_graph.h"
#include "geometry/plane/triangulation.h"

DEFINE_string(out, "",
              "run: the folder of results; deform, animate: the file or files of the "
              "deformed shape");
DEFINE_string(frames, "", "animate: the frames of a mesh animation, such as horse-%03d.obj");
DEFINE_string(particles, "", "animate: a CSV file of particles: frame, id, x, y, z");
DEFINE_string(edit, "", "deform, animate: the YAML file of what is selected and where it goes");
DEFINE_string(metrics, "", "deform, animate: a JSON file for the measurements");
DEFINE_string(picture, "", "deform, animate: a PNG file of the shape or frames before and after");
DEFINE_bool(strict, false, "deform: write nothing if the result is not what the edit asks for");
DEFINE_int32(nodes, deformlab::GraphOptions{}.nodes,
             "deform: the most nodes that the graph may have");
DEFINE_int32(
    vertices, deformlab::TriangulationOptions{}.vertices,
    "deform, animate: number of vertices of a drawing's mesh; 0 chooses it by the width of its "
    "limbs");

namespace deformlab {
namespace {

// Libraries define further flags, some of which read files or end the program. They are no part of
// this program's command line.
const std::vector<std::string> kFlags{"out",     "edit",     "frames",     "particles",
                                      "metrics", "picture",  "nodes",      "vertices",
                                      "strict",  "markdown", "minloglevel"};

/// The value of a flag that has no `=`: true, or the next argument.
std::string value_of(const std::string& name, const std::string& type,
                     const std::vector<std::string>& arguments, std::size_t& i) {
  if (type == "bool") return "true";
  if (++i < arguments.size()) return arguments[i];
  throw InputError(fmt::format("--{} needs a value", name));
}

/// Sets the flag of arguments[i], and moves i to the last argument that belongs to it.
void set_flag(const std::vector<std::string>& arguments, std::size_t& i) {
  const std::string& argument = arguments[i];
  const std::size_t begin = std::min(argument.find_first_not_of('-'), argument.size());
  const std::size_t equals = std::max(begin, std::min(argument.find('='), argument.size()));
  const std::string name = argument.substr(begin, equals - begin);
  gflags::CommandLineFlagInfo flag;
  if (std::ranges::find(kFlags, name) == kFlags.end() ||
      !gflags::GetCommandLineFlagInfo(name.c_str(), &flag)) {
    throw InputError(
        fmt::format("unknown flag {}; {}", quote(argument), known_names(name, kFlags)));
  }
  const std::string value = equals < argument.size() ? argument.substr(equals + 1)
                                                     : value_of(name, flag.type, arguments, i);
  if (gflags::SetCommandLineOption(name.c_str(), value.c_str()).empty()) {
    throw InputError(
        fmt::format("wrong value {} for --{}; expected {}", quote(value), name, flag.type));
  }
}

}  // namespace

// The parser of gflags would end the program with status 1 and would not suggest a flag.
Flags parse_flags(const std::vector<std::string>& arguments) {
  Flags flags;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool is_flag = arguments[i].size() > 1 && arguments[i][0] == '-';
    is_flag ? set_flag(arguments, i) : flags.words.push_back(arguments[i]);
  }
  flags.frames = FLAGS_frames;
  flags.particles = FLAGS_particles;
  flags.line = {.input = {},
                .edit = FLAGS_edit,
                .out = FLAGS_out,
                .metrics = FLAGS_metrics,
                .picture = FLAGS_picture,
                .strict = FLAGS_strict,
                .nodes = FLAGS_nodes,
                .vertices = FLAGS_vertices};
  return flags;
}

}  // namespace deformlab
