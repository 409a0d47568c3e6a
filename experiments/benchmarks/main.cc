// deformlab_bench: Google Benchmark's figures, then our solver against Ceres' best configuration.
#include <benchmark/benchmark.h>
#include <dlfcn.h>
#include <gflags/gflags.h>

#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/benchmarks/comparison.h"
#include "experiments/benchmarks/duel.h"
#include "experiments/benchmarks/growth.h"
#include "experiments/benchmarks/rigid_comparison.h"
#include "experiments/environment.h"
#include "experiments/results.h"
#include "geometry/error.h"

DEFINE_string(comparison, "auto",
              "with the peers: yes, no, rigid (drawings only), or auto: unless a filter is given");
DEFINE_int32(repetitions, 5, "of each pair in the comparison");
DEFINE_string(duels, "auto", "the table of speeds: yes, no, or auto: unless a filter is given");
DEFINE_string(duel_nodes, "222,425,1048,4000", "graph sizes of that table");
DEFINE_string(json, "", "write the table of speeds into this JSON file");
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

std::string duel_all() {
  std::vector<Duel> all;
  std::stringstream sizes(FLAGS_duel_nodes);
  for (std::string nodes; std::getline(sizes, nodes, ',');) {
    const std::vector<Duel> more = duels(std::stoi(nodes), FLAGS_repetitions);
    all.insert(all.end(), more.begin(), more.end());
    std::cout << to_markdown(more) << "\n" << std::flush;
    if (!FLAGS_json.empty()) write_text(FLAGS_json, to_json(all));
  }
  return to_markdown(all);
}

std::string report(const std::string& figures, const std::string& comparisons,
                   const std::string& rigid, const std::string& speeds) {
  return "# Benchmarks\n\nWritten by `./deformlab bench --report=results/benchmarks.md`. Ratios "
         "mean something on another machine, milliseconds do not.\n\n" +
         context() +
         "\n## Whole edits against others\n\nEach ratio is of medians of this run, ours and theirs "
         "in turns, one thread. From rest, compilation and Ceres' preprocessing are counted; of a "
         "drag nothing but the update, on a problem that Ceres keeps too.\n\n" +
         speeds +
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
               "          [--json=<JSON file>] of the table\n"
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
  std::string comparisons, rigid, speeds;
  if (FLAGS_duels == "yes" || (FLAGS_duels == "auto" && !filtered)) speeds = duel_all();
  const bool all = FLAGS_comparison == "yes" || (FLAGS_comparison == "auto" && !filtered);
  if (all || FLAGS_comparison == "rigid") rigid = compare_rigid_shapes(holds);
  if (all) comparisons = compare_all(holds);
  if (!FLAGS_report.empty()) write_text(FLAGS_report, report(figures, comparisons, rigid, speeds));
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
