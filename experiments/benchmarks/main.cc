// deformlab_bench: Google Benchmark's figures, then our solver against Ceres' best configuration.
#include <benchmark/benchmark.h>
#include <dlfcn.h>
#include <gflags/gflags.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/benchmarks/comparison.h"
#include "experiments/benchmarks/duel.h"
#include "experiments/benchmarks/growth.h"
#include "experiments/benchmarks/rigid_comparison.h"
#include "experiments/benchmarks/scaling.h"
#include "experiments/commands/environment.h"
#include "experiments/commands/results.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

DEFINE_string(comparison, "auto",
              "with the peers: yes, no, rigid (drawings only), or auto: unless a filter is given");
DEFINE_int32(repetitions, 5, "of each pair in the comparison");
DEFINE_string(duels, "auto", "the table of speeds: yes, no, or auto: unless a filter is given");
DEFINE_string(duel_nodes, "222,425,1048,4000", "graph sizes of that table");
DEFINE_string(scaling, "auto", "growth and a million vertices: yes, no, or auto: unless filtered");
DEFINE_string(scaling_nodes, "100,320,1000,3200,10000,32000", "graph sizes of the growth");
DEFINE_int32(scaling_side, 401, "vertices along a side of the plane that they are on");
DEFINE_string(large_nodes, "10000,20000", "graph sizes of the large plane");
DEFINE_int32(large_side, 1000, "vertices along its side");
DEFINE_string(json, "", "write the table of speeds, growth and transfer into this JSON file");
DEFINE_string(report, "", "write all figures into this Markdown file");

namespace deformlab {
namespace {

// A threaded OpenBLAS may be installed instead of the serial one.
void force_one_thread() {
  using SetThreads = void (*)(int);
  if (void* found = dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) {
    reinterpret_cast<SetThreads>(found)(1);
  }
}

std::string context() {
  std::string text;
  for (const auto& [name, value] : environment()) text += "- " + name + ": " + value + "\n";
  return text;
}

std::string compare_all(bool& holds) {
  std::string text, gauss_newton_blas, ceres_blas;
  for (const int nodes : {222, 425, 1048}) {
    const Comparison comparison = compare(nodes, FLAGS_repetitions);
    const std::string table = to_markdown(comparison) + "\n";
    std::cout << table << std::flush;
    text += table;
    holds = holds && comparison.holds();
    gauss_newton_blas = comparison.our_blas;
    ceres_blas = comparison.best().blas;
  }
  const std::string blas =
      "BLAS of gauss_newton: " + gauss_newton_blas + "\n\nBLAS of ceres: " + ceres_blas + "\n";
  std::cout << blas;
  return text + blas;
}

std::string compare_rigid_shapes(bool& holds) {
  std::vector<RigidComparison> all;
  for (const int vertices : {93, 150, 300, 1000, 5000, 20000}) {
    all.push_back(compare_rigid(vertices, FLAGS_repetitions));
    holds = holds && all.back().holds();
  }
  std::string text = to_markdown(all);
  std::cout << text << std::flush;
  return text;
}

std::vector<int> sizes(const std::string& list) {
  std::vector<int> result;
  std::stringstream text(list);
  for (std::string nodes; std::getline(text, nodes, ',');) result.push_back(std::stoi(nodes));
  return result;
}

std::string duel_all(nlohmann::ordered_json& json) {
  std::vector<Duel> all;
  for (const int nodes : sizes(FLAGS_duel_nodes)) {
    const std::vector<Duel> more = duels(nodes, FLAGS_repetitions);
    all.insert(all.end(), more.begin(), more.end());
    std::cout << to_markdown(more) << "\n" << std::flush;
  }
  json["duels"] = to_json(all);
  return to_markdown(all);
}

std::string scale_all(nlohmann::ordered_json& json) {
  std::vector<Scale> growing, large;
  const int repetitions = std::min(FLAGS_repetitions, 3);  // the largest take seconds
  for (const int nodes : sizes(FLAGS_scaling_nodes)) {
    growing.push_back(scale(FLAGS_scaling_side, nodes, repetitions));
  }
  for (const int nodes : sizes(FLAGS_large_nodes)) {
    large.push_back(scale(FLAGS_large_side, nodes, repetitions));
  }
  json["scaling"] = to_json(growing, large);
  const std::string text = to_markdown(growing, large);
  std::cout << text << "\n" << std::flush;
  return text;
}

std::string report(const std::string& figures, const std::string& comparisons,
                   const std::string& rigid, const std::string& speeds, const std::string& scales) {
  return "# Benchmarks\n\nWritten by `./deformlab bench --report=results/benchmarks.md`. Ratios "
         "mean something on another machine, milliseconds do not.\n\n" +
         context() +
         "\n## Whole edits against others\n\nEach ratio is of medians of this run, ours and theirs "
         "in turns, one thread. From rest, compilation and Ceres' preprocessing are counted; of a "
         "drag nothing but an update that follows another, on a problem that Ceres keeps too.\n\n" +
         speeds +
         "\n## Growth, and a million vertices\n\nA bumpy plane, deformed as the reference scene "
         "is, "
         "by the default solver on one thread; medians, but of the registration.\n\n" +
         scales +
         "\n## A step against Ceres\n\nThe reference scene: a bumpy plane of 201×201 vertices, "
         "4,020 handles, one strip lifted at once. Both solvers minimise the same terms from rest "
         "and stop by the same rule, in turns, on one thread. A step is the mean of a solve's: "
         "without our compilation and without Ceres' preprocessing. A whole solve is with both.\n"
         "\n" +
         comparisons +
         "\n## A drawing against CGAL\n\nThe rigid 2D shape beside CGAL's Surface_mesh_deformation "
         "(spokes and rims, Eigen's SparseLU) on the same mesh, three handles, one thread.\n\n" +
         rigid + "\n## Figures\n\n" + figures;
}

void print_help() {
  benchmark::PrintDefaultHelp();
  std::cout << "deformlab_bench's own:\n"
               "          [--comparison=auto|yes|no|rigid] with the peers (auto: unless filtered)\n"
               "          [--repetitions=<pairs of solves>]\n"
               "          [--duels=auto|yes|no] the table of speeds (auto: unless filtered)\n"
               "          [--duel_nodes=222,425,1048,4000] its graph sizes\n"
               "          [--scaling=auto|yes|no] growth and a million vertices\n"
               "          [--scaling_nodes=100,320,1000,3200,10000,32000] [--scaling_side=401]\n"
               "          [--large_nodes=10000,20000] [--large_side=1000]\n"
               "          [--json=<JSON file>] of the table and the growth\n"
               "          [--report=<Markdown file>]\n";
}

int run(bool filtered) {
  force_one_thread();
  std::cout << context() << std::flush;
  GrowthReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  const std::string figures = reporter.to_markdown();
  std::cout << "\n" << figures << "\n" << std::flush;
  bool holds = true;
  std::string comparisons, rigid, speeds, scales;
  const auto asked = [&](const std::string& flag) {
    return flag == "yes" || (flag == "auto" && !filtered);
  };
  nlohmann::ordered_json json{{"environment", environment()}};
  if (asked(FLAGS_duels)) speeds = duel_all(json);
  if (asked(FLAGS_scaling)) scales = scale_all(json);
  if (!FLAGS_json.empty()) write_file(FLAGS_json, json.dump(2) + "\n");
  const bool all = asked(FLAGS_comparison);
  if (all || FLAGS_comparison == "rigid") rigid = compare_rigid_shapes(holds);
  if (all) comparisons = compare_all(holds);
  if (!FLAGS_report.empty())
    write_file(FLAGS_report, report(figures, comparisons, rigid, speeds, scales));
  return holds ? 0 : 1;
}

}  // namespace
}  // namespace deformlab

int main(int argc, char** argv) {
  bool filtered = false;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    filtered = filtered || argument.starts_with("--benchmark_filter") ||
               argument.starts_with("--benchmark_list");
  }
  benchmark::Initialize(&argc, argv, deformlab::print_help);
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  try {
    return deformlab::run(filtered);
  } catch (const deformlab::InputError& error) {
    std::fprintf(stderr, "deformlab_bench: %s\n", error.what());
    return 1;
  }
}
