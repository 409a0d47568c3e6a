#include <fmt/format.h>
#include <glog/logging.h>
#include <malloc.h>

#include <algorithm>
#include <limits>

#include "experiments/commands/commands.h"
#include "experiments/commands/flags.h"
#include "experiments/commands/standard_streams.h"
#include "experiments/config/suggest.h"
#include "geometry/core/error.h"

namespace {

using namespace deformlab;

const std::vector<std::string> kCommands{"run", "deform", "animate", "list", "help", "version"};

int dispatch(const Flags& flags) {
  if (flags.words.empty()) {
    throw InputError(fmt::format("no command; {}", known_names("", kCommands)));
  }
  const std::string& command = flags.words.front();
  const std::vector<std::string> arguments(flags.words.begin() + 1, flags.words.end());
  if (command == "run") {
    return run_command(arguments, flags.line.out.empty() ? "results" : flags.line.out);
  }
  if (command == "deform") return deform_command(arguments, flags.line);
  if (command == "animate") {
    return animate_command(arguments, flags.frames, flags.particles, flags.line);
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

// The arrays of a large shape have many megabytes each. The GNU library would give each of them
// back to the system, which clears the pages of the next one, in a quarter of the time of a run.
void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

int run_command_line(const std::vector<std::string>& arguments) {
  // By default only warnings are shown, without the prefix that a log file needs.
  FLAGS_logtostderr = true;
  FLAGS_minloglevel = google::GLOG_WARNING;
  FLAGS_log_prefix = false;
  google::InitGoogleLogging("deformlab");
  // These flags are commands, whatever else stands beside them.
  const auto asks_for = [&](const std::string& word) {
    return std::ranges::count(arguments, "-" + word) + std::ranges::count(arguments, "--" + word);
  };
  if (arguments.empty() || asks_for("help") || asks_for("h")) return dispatch({.words = {"help"}});
  if (asks_for("version")) return dispatch({.words = {"version"}});
  return dispatch(parse_flags(arguments));
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory();
  return run_program("deformlab", [&] {
    return run_command_line({argv + std::min(argc, 1), argv + argc});
  });
}
