// deformlab_bench: micro benchmarks by Google Benchmark, then the scenarios, each of which compares
// two ways of the same work, then the growth with the size of the graph.
#include <benchmark/benchmark.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <gflags/gflags.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/benchmarks/growth.h"
#include "experiments/benchmarks/report.h"
#include "experiments/benchmarks/scaling.h"
#include "experiments/benchmarks/scenarios.h"
#include "experiments/commands/environment.h"
#include "experiments/commands/standard_streams.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

DEFINE_string(scenarios, "auto",
              "which scenarios: all, none, a part of their names, or auto (all, unless the "
              "benchmarks are filtered)");
DEFINE_string(sizes, "", "the sizes of all scenarios, instead of their own, separated by commas");
DEFINE_int32(repetitions, 5, "how many pairs of runs a scenario is measured with, at least 1");
DEFINE_string(scaling, "auto",
              "growth and a million vertices: yes, no, or auto (yes, unless the benchmarks are "
              "filtered or scenarios are chosen)");
DEFINE_string(scaling_nodes, "100,320,1000,3200,10000,32000", "graph sizes of the growth");
DEFINE_int32(scaling_side, 401, "vertices along a side of the plane of the growth");
DEFINE_string(large_nodes, "10000,20000", "graph sizes of the large plane");
DEFINE_int32(large_side, 1000, "vertices along a side of the large plane");
DEFINE_string(out, "auto",
              "the folder of benchmarks.md and benchmarks.json, or auto (results, if everything is "
              "measured; otherwise nothing is written)");

namespace deformlab {
namespace {

// A threaded OpenBLAS may be installed instead of the serial one.
void force_one_thread() {
  using SetThreads = void (*)(int);
  if (void* found = dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) {
    reinterpret_cast<SetThreads>(found)(1);
  }
}

int positive(const std::string& text, const char* flag) {
  try {
    std::size_t end = 0;
    const int value = std::stoi(text, &end);
    if (end == text.size() && value > 0) return value;
  } catch (const std::exception&) {  // reported below, like other mistakes
  }
  throw InputError(fmt::format("--{}: '{}' is not a whole number above 0", flag, text));
}

std::vector<int> sizes(const std::string& list, const char* flag) {
  std::vector<int> result;
  std::stringstream text(list);
  for (std::string size; std::getline(text, size, ',');) result.push_back(positive(size, flag));
  return result;
}

bool is_chosen(const Scenario& scenario, bool filtered) {
  if (FLAGS_scenarios == "auto") return !filtered;
  if (FLAGS_scenarios == "all") return true;
  if (FLAGS_scenarios == "none") return false;
  return fmt::format("{}, against {}", scenario.name, scenario.against).find(FLAGS_scenarios) !=
         std::string::npos;
}

std::vector<Measurement> measure_scenarios(bool filtered) {
  const std::vector<int> own_sizes = sizes(FLAGS_sizes, "sizes");
  std::vector<Measurement> all;
  for (const Scenario& scenario : scenarios()) {
    if (!is_chosen(scenario, filtered)) continue;
    for (const int size : own_sizes.empty() ? scenario.sizes : own_sizes) {
      all.push_back(measure(scenario, size, FLAGS_repetitions));
      const Measurement& m = all.back();
      const Spread ratio = m.ratio();
      print_out(fmt::format("{}, against {}, {} {}: {:.3g} times as fast ({:.3g} to {:.3g})\n",
                            m.scenario, m.against, m.size, m.unit, ratio.median, ratio.least,
                            ratio.most));
    }
  }
  if (all.empty() && FLAGS_scenarios != "auto" && FLAGS_scenarios != "none") {
    throw InputError(
        fmt::format("--scenarios: no scenario's name has '{}' in it; --scenarios=all "
                    "--sizes=30 --repetitions=1 shows the names",
                    FLAGS_scenarios));
  }
  return all;
}

struct Growth {
  std::vector<Scale> growing, large;
};

Growth measure_growth() {
  Growth result;
  const int repetitions = std::min(FLAGS_repetitions, 3);  // because the largest takes seconds
  for (const int nodes : sizes(FLAGS_scaling_nodes, "scaling_nodes")) {
    result.growing.push_back(scale(FLAGS_scaling_side, nodes, repetitions));
  }
  for (const int nodes : sizes(FLAGS_large_nodes, "large_nodes")) {
    result.large.push_back(scale(FLAGS_large_side, nodes, repetitions));
  }
  return result;
}

std::string section(const char* title, const char* about, const std::string& content) {
  return content.empty() ? "" : fmt::format("\n## {}\n\n{}\n\n{}", title, about, content);
}

std::string report(const std::string& comparisons, const std::string& growth,
                   const std::string& figures) {
  return "# Benchmarks\n\n`./deformlab bench` wrote this file. The ratios mean something on "
         "another "
         "machine, the milliseconds do not.\n\n" +
         environment_markdown() +
         section(
             "Comparisons",
             "Each ratio says how many times as fast our way is as the other one. Both run in "
             "turns on one thread. The first number is the median over the pairs, and the "
             "smallest and the largest ratio stand in brackets. Times from rest count our "
             "compilation and Ceres' preprocessing. A drag counts only an update that follows "
             "another one, on a problem that Ceres keeps too; p50, p95 and p99 are of further "
             "drags, of which so many per cent took no longer. A step is the mean over a solve, "
             "without compilation and preprocessing. The scene is a bumpy plane of 201×201 "
             "vertices with 4,020 handles, of which one strip is lifted at once. A drawing is "
             "a shape of five arms with three handles.",
             comparisons) +
         section("Growth, and a million vertices",
                 "A bumpy plane is deformed as in the scene above, by the default solver on one "
                 "thread. All times are medians, except that the registration runs once.",
                 growth) +
         section("Micro benchmarks", "Google Benchmark measured these times.", figures);
}

void print_help() {
  benchmark::PrintDefaultHelp();
  std::fflush(stdout);  // if this fails, so does what follows
  std::vector<gflags::CommandLineFlagInfo> flags;
  gflags::GetAllFlags(&flags);
  print_out("\nFlags of deformlab_bench itself:\n");
  for (const auto& flag : flags) {
    if (!flag.filename.ends_with("benchmarks/main.cc")) continue;
    print_out(
        fmt::format("  --{}={}\n      {}\n", flag.name, flag.default_value, flag.description));
  }
}

int run(bool filtered) {
  force_one_thread();
  if (FLAGS_repetitions < 1) {
    throw InputError(fmt::format("--repetitions: {} is not at least 1", FLAGS_repetitions));
  }
  print_out(environment_markdown() + "\n");
  GrowthReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);

  const std::vector<Measurement> measurements = measure_scenarios(filtered);
  nlohmann::ordered_json json{{"environment", environment()}, {"scenarios", to_json(measurements)}};
  const std::string comparisons = measurements.empty() ? "" : to_markdown(measurements);

  const bool everything = !filtered && FLAGS_scenarios == "auto" && FLAGS_sizes.empty();
  std::string growth;
  if (FLAGS_scaling == "yes" || (FLAGS_scaling == "auto" && everything)) {
    const Growth measured = measure_growth();
    json["scaling"] = to_json(measured.growing, measured.large);
    growth = to_markdown(measured.growing, measured.large);
  }
  const std::string text = report(comparisons, growth, filtered ? "" : reporter.to_markdown());
  print_out("\n" + text);

  std::filesystem::path folder = FLAGS_out;
  if (FLAGS_out == "auto") folder = everything && !growth.empty() ? "results" : "";
  if (!folder.empty()) {
    std::filesystem::create_directories(folder);
    write_file(folder / "benchmarks.md", text);
    write_file(folder / "benchmarks.json", json.dump(2) + "\n");
  }
  return 0;
}

int run_command_line(int argc, char** argv) {
  OutBuffer out;
  std::streambuf* const usual = std::cout.rdbuf(&out);  // Google Benchmark writes to it
  std::cout.exceptions(std::ios::badbit);
  const auto restore = [usual](void*) { std::cout.rdbuf(usual); };
  const std::unique_ptr<void, decltype(restore)> at_end(&out, restore);
  bool filtered = false;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    filtered = filtered || argument.starts_with("--benchmark_filter") ||
               argument.starts_with("--benchmark_list");
  }
  benchmark::Initialize(&argc, argv, print_help);
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  return run(filtered);
}

}  // namespace
}  // namespace deformlab

int main(int argc, char** argv) {
  return deformlab::run_program("deformlab_bench",
                                [&] { return deformlab::run_command_line(argc, argv); });
}
