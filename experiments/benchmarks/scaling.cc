#include "experiments/benchmarks/scaling.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "experiments/benchmarks/ab_runner.h"
#include "experiments/benchmarks/growth.h"
#include "experiments/benchmarks/reference_scene.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

template <class Action>
double median_ms(int repetitions, Action&& action) {
  std::vector<double> all;
  for (int i = 0; i < repetitions; ++i) all.push_back(ms_of(action));
  return spread(std::move(all)).median;
}

// The bytes that the process holds in memory (VmRSS), or the most that it has held since
// `forget_peak` (VmHWM), as Linux counts them; 0 on other systems.
double resident(const char* key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key)) return 1024 * std::stod(line.substr(std::strlen(key)));
  }
  return 0;
}

void forget_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
}

// The copy reads half of the bytes that a transfer reads and writes, and writes as many.
double copy_ms(const Embedding& e, int repetitions) {
  const std::size_t vertex = e.nodes.rows() * (sizeof(int) + sizeof(double)) + 6 * sizeof(double);
  const std::vector<char> from(std::size_t(e.v.cols()) * vertex / 2, 1);
  std::vector<char> to(from.size());
  return median_ms(repetitions, [&] { std::copy(from.begin(), from.end(), to.begin()); });
}

void time_transfer(const EmbeddedDeformation& deformation, const Shape& rest, int repetitions,
                   Scale& scale) {
  const DeformationGraph& graph = deformation.graph();
  const Transformations X = deformation.transformations();
  const Embedding& e = deformation.embedding();
  Eigen::Matrix3Xd V(3, rest.V.cols()), N(3, rest.V.cols());
  scale.positions_ms = median_ms(repetitions, [&] { transfer_positions(X, graph.g, e, V); });
  scale.normals_ms = median_ms(repetitions, [&] { transfer_normals(X, rest.N, e, N); });
  scale.copy_ms = copy_ms(e, repetitions);
}

std::string rows(const std::vector<Scale>& all) {
  std::string text =
      "| vertices | handles | nodes | registration, ms | compilation | update | steps | CG "
      "iterations | linear solver | status | F | peak memory, kB a node |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Scale& s : all) {
    text += fmt::format(
        "| {} | {} | {} | {:.0f} | {:.1f} | {:.1f} | {} | {} | {} | {} | {:.9g} | {:.1f} |\n",
        s.vertices, s.handles, s.nodes, s.register_ms, s.compile_ms, s.update_ms, s.steps,
        s.cg_iterations, s.linear_solver, s.status, s.cost, s.peak_bytes / 1024 / s.nodes);
  }
  return text;
}

nlohmann::ordered_json to_json(const Scale& s) {
  return {{"vertices", s.vertices},
          {"handles", s.handles},
          {"nodes", s.nodes},
          {"register_ms", s.register_ms},
          {"compile_ms", s.compile_ms},
          {"update_ms", s.update_ms},
          {"positions_ms", s.positions_ms},
          {"normals_ms", s.normals_ms},
          {"copy_ms", s.copy_ms},
          {"steps", s.steps},
          {"cg_iterations", s.cg_iterations},
          {"cost", s.cost},
          {"linear_solver", s.linear_solver},
          {"status", s.status},
          {"peak_bytes", s.peak_bytes}};
}

}  // namespace

nlohmann::ordered_json to_json(const std::vector<Scale>& growing, const std::vector<Scale>& large) {
  nlohmann::ordered_json json;
  json["exponent"] = growth(growing);
  for (const Scale& s : growing) json["growing"].push_back(to_json(s));
  for (const Scale& s : large) json["large"].push_back(to_json(s));
  return json;
}

Scale scale(int side, int nodes, int repetitions) {
  const ReferenceScene scene = lifted_plane(side);
  Scale result;
  result.vertices = side * side;
  result.nodes = nodes;
  result.handles = static_cast<int>(scene.handles.moved.size());
  EmbeddedDeformationOptions options;
  options.graph.nodes = nodes;
  double seconds = 0;
  const Stopwatch registration(seconds);
  EmbeddedDeformation deformation(scene.shape, options);
  result.register_ms = 1e3 * registration.elapsed();
  forget_peak();
  const double before = resident("VmRSS:");
  std::vector<std::pair<double, double>> runs;
  for (int i = 0; i < repetitions; ++i) {
    deformation.reset();
    const double compile = ms_of([&] { deformation.compile(scene.handles); });
    Report report;
    const double update = ms_of([&] { report = deformation.update(scene.targets); });
    runs.emplace_back(compile, update - 1e3 * report.seconds.at("transfer"));
    result.steps = report.solve.iterations.size();
    result.cg_iterations = report.solve.cg_iterations;
    result.cost = report.solve.final_cost;
    result.linear_solver = report.solve.linear_solver;
    result.status = to_string(report.solve.status);
    if (i == 0) result.peak_bytes = std::max(0.0, resident("VmHWM:") - before);
  }
  std::ranges::nth_element(runs, runs.begin() + std::ssize(runs) / 2, {},
                           [](const auto& run) { return run.first + run.second; });
  std::tie(result.compile_ms, result.update_ms) = runs[runs.size() / 2];
  time_transfer(deformation, scene.shape, 2 * repetitions + 1, result);
  return result;
}

double growth(const std::vector<Scale>& all) {
  std::vector<std::pair<double, double>> points;
  for (const Scale& s : all) points.emplace_back(s.nodes, s.to_convergence_ms());
  return exponent(points);
}

std::string to_markdown(const std::vector<Scale>& growing, const std::vector<Scale>& large) {
  std::string text = rows(growing);
  text +=
      fmt::format("\nThe time to convergence (compilation and update) grows with nodes^{:.2f}.\n\n",
                  growth(growing));
  text += rows(large);
  text +=
      "\n| vertices | nodes | positions (Eq. 2), ms | normals (Eq. 3), ms | a copy of as many "
      "bytes, ms | share of its bandwidth: positions, normals | registration over one transfer of "
      "both; of positions |\n|---|---|---|---|---|---|---|\n";
  for (const Scale& s : large) {
    text += fmt::format(
        "| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f}, {:.2f} | {:.0f}; {:.0f} |\n", s.vertices,
        s.nodes, s.positions_ms, s.normals_ms, s.copy_ms, s.copy_ms / s.positions_ms,
        s.copy_ms / s.normals_ms, s.register_ms / (s.positions_ms + s.normals_ms),
        s.register_ms / s.positions_ms);
  }
  return text;
}

}  // namespace deformlab
