#include <fmt/format.h>
#include <gflags/gflags.h>
#include <glog/logging.h>

#include <algorithm>
#include <cstdio>
#include <exception>

#include "experiments/commands/commands.h"
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
    std::fputs((command == "help" ? help_text() : list_text()).c_str(), stdout);
    return 0;
  }
  throw InputError(fmt::format("unknown command {}; {}", quote(command),
                               known_names(command, {"run", "deform", "animate", "list", "help"})));
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
    if (!gflags::GetCommandLineFlagInfo(name.c_str(), &flag)) {
      throw InputError(
          fmt::format("unknown flag {}; {}", quote(argument),
                      known_names(name, {"out", "edit", "frames", "particles", "metrics", "picture",
                                         "nodes", "vertices", "strict"})));
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

bool asks_for_help(int argc, char** argv) {
  if (argc < 2) return true;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--help" || argument == "-help" || argument == "-h") return true;
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  // By default only warnings are shown, without the prefix that a log file needs.
  FLAGS_logtostderr = true;
  FLAGS_minloglevel = google::GLOG_WARNING;
  FLAGS_log_prefix = false;
  google::InitGoogleLogging("deformlab");
  try {
    if (asks_for_help(argc, argv)) return dispatch("help", {});
    const std::vector<std::string> arguments = parse_flags(argc, argv);
    if (arguments.empty()) throw InputError("no command; known: run, deform, animate, list, help");
    return dispatch(arguments.front(), {arguments.begin() + 1, arguments.end()});
  } catch (const InputError& e) {
    std::fprintf(stderr, "deformlab: %s\n", e.what());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "deformlab: out of memory: use fewer nodes or a smaller shape\n");
    return 4;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "deformlab: %s\n", e.what());
    return 4;
  }
}
