#include <fmt/format.h>
#include <gflags/gflags.h>
#include <glog/logging.h>

#include <algorithm>

#include "experiments/commands/commands.h"
#include "experiments/commands/standard_streams.h"
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
    "deform a drawing: number of vertices of its mesh; 0 chooses it by the width of its limbs");

namespace {

using namespace deformlab;

const std::vector<std::string> kCommands{"run", "deform", "animate", "list", "help", "version"};

// Libraries define further flags, some of which read files or end the program. They are no part of
// this program's command line.
const std::vector<std::string> kFlags{"out",     "edit",     "frames",     "particles",
                                      "metrics", "picture",  "nodes",      "vertices",
                                      "strict",  "markdown", "minloglevel"};

int dispatch(const std::string& command, const std::vector<std::string>& arguments) {
  if (command == "run") return run_command(arguments, FLAGS_out.empty() ? "results" : FLAGS_out);
  const CommandLine line{.input = {},
                         .edit = FLAGS_edit,
                         .out = FLAGS_out,
                         .metrics = FLAGS_metrics,
                         .picture = FLAGS_picture,
                         .strict = FLAGS_strict,
                         .nodes = FLAGS_nodes,
                         .vertices = FLAGS_vertices};
  if (command == "deform") return deform_command(arguments, line);
  if (command == "animate") {
    return animate_command(arguments, FLAGS_frames, FLAGS_particles, line);
  }
  if (command == "help" || command == "list") {
    print_out(command == "help" ? help_text() : list_text());
    return 0;
  }
  if (command == "version") {
    print_out(version_text());
    return 0;
  }
  throw InputError(
      fmt::format("unknown command {}; {}", quote(command), known_names(command, kCommands)));
}

std::string value_of(const std::string& name, const std::string& type, int argc, char** argv,
                     int& i) {
  if (type == "bool") return "true";
  if (++i < argc) return argv[i];
  throw InputError(fmt::format("--{} needs a value", name));
}

// The parser of gflags would end the program with status 1 and would not suggest a flag.
std::vector<std::string> parse_flags(int argc, char** argv) {
  std::vector<std::string> others;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.size() < 2 || argument[0] != '-') {
      others.push_back(argument);
      continue;
    }
    const std::size_t begin = std::min(argument.find_first_not_of('-'), argument.size());
    const std::size_t equals = std::min(argument.find('='), argument.size());
    const std::string name = argument.substr(begin, equals - begin);
    gflags::CommandLineFlagInfo flag;
    if (std::ranges::find(kFlags, name) == kFlags.end() ||
        !gflags::GetCommandLineFlagInfo(name.c_str(), &flag)) {
      throw InputError(
          fmt::format("unknown flag {}; {}", quote(argument), known_names(name, kFlags)));
    }
    const std::string value = equals < argument.size() ? argument.substr(equals + 1)
                                                       : value_of(name, flag.type, argc, argv, i);
    if (gflags::SetCommandLineOption(name.c_str(), value.c_str()).empty()) {
      throw InputError(
          fmt::format("wrong value {} for --{}; expected {}", quote(value), name, flag.type));
    }
  }
  return others;
}

// Whether a word stands on the command line as a flag.
bool asks_for(const std::string& word, int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc, [&](const std::string& argument) {
    return argument == "--" + word || argument == "-" + word;
  });
}

int run_command_line(int argc, char** argv) {
  // By default only warnings are shown, without the prefix that a log file needs.
  FLAGS_logtostderr = true;
  FLAGS_minloglevel = google::GLOG_WARNING;
  FLAGS_log_prefix = false;
  google::InitGoogleLogging("deformlab");
  if (argc < 2 || asks_for("help", argc, argv) || asks_for("h", argc, argv)) {
    return dispatch("help", {});
  }
  if (asks_for("version", argc, argv)) return dispatch("version", {});
  const std::vector<std::string> arguments = parse_flags(argc, argv);
  if (arguments.empty())
    throw InputError(fmt::format("no command; {}", known_names("", kCommands)));
  return dispatch(arguments.front(), {arguments.begin() + 1, arguments.end()});
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("deformlab", [&] { return run_command_line(argc, argv); });
}
