#include "experiments/benchmarks/growth.h"

#include <cmath>
#include <cstdio>
#include <utility>

namespace deformlab {
namespace {

std::string big_o(benchmark::BigO complexity) {
  switch (complexity) {
    case benchmark::o1:
      return "1";
    case benchmark::oN:
      return "N";
    case benchmark::oNSquared:
      return "N²";
    case benchmark::oNCubed:
      return "N³";
    case benchmark::oLogN:
      return "log N";
    case benchmark::oNLogN:
      return "N log N";
    default:
      return "none";
  }
}

std::string family_of(const benchmark::BenchmarkReporter::Run& run) {
  return run.run_name.function_name;
}

std::string text(double value, const char* pattern) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, pattern, value);
  return buffer;
}

}  // namespace

double exponent(const std::vector<std::pair<double, double>>& points) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [nodes, time] : points) {
    const double u = std::log(nodes), v = std::log(time);
    n += 1, x += u, y += v, xx += u * u, xy += u * v;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

void GrowthReporter::ReportRuns(const std::vector<Run>& runs) {
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) {
    Family& family = families_[family_of(run)];
    if (run.report_big_o) {
      family.big_o = big_o(run.complexity);
    } else if (!run.error_occurred && run.run_type == Run::RT_Iteration) {
      const double time = run.GetAdjustedRealTime();  // in ms, the unit of all our benchmarks
      if (run.complexity_n > 0) family.points.emplace_back(double(run.complexity_n), time);
      std::string rest;
      for (const auto& [name, counter] : run.counters) {
        const bool rate = name == "items_per_second";
        rest += (rest.empty() ? "" : ", ") + (rate ? "vertices per second" : name) + " " +
                text(counter.value, rate ? "%.3g" : "%.9g");
      }
      rows_.push_back({run.benchmark_name(), time, rest});
    }
  }
}

std::string GrowthReporter::to_markdown() const {
  std::string result = "| benchmark | ms | |\n|---|---|---|\n";
  for (const Row& row : rows_) {
    result += "| " + row.name + " | " + text(row.ms, "%.3f") + " | " + row.rest + " |\n";
  }
  result += "\n| growth with the number of nodes | fitted exponent | Google Benchmark's fit |\n";
  result += "|---|---|---|\n";
  for (const auto& [name, family] : families_) {
    if (family.points.size() < 2) continue;
    result +=
        "| " + name + " | " + text(exponent(family.points), "%.2f") + " | " + family.big_o + " |\n";
  }
  return result;
}

}  // namespace deformlab
