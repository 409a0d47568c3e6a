#include "experiments/benchmarks/growth.h"

#include <fmt/format.h>

#include <cmath>
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
    Family& family = families_[run.run_name.function_name];
    if (run.report_big_o) {
      family.big_o = big_o(run.complexity);
    } else if (!run.error_occurred && run.run_type == Run::RT_Iteration) {
      const double time = run.GetAdjustedRealTime();  // [ms], the unit of all our benchmarks
      if (run.complexity_n > 0) family.points.emplace_back(double(run.complexity_n), time);
      std::string rest;
      for (const auto& [name, counter] : run.counters) {
        if (!rest.empty()) rest += ", ";
        rest += name == "items_per_second"
                    ? fmt::format("vertices per second {:.3g}", double(counter.value))
                    : fmt::format("{} {:.9g}", name, double(counter.value));
      }
      rows_.push_back({run.benchmark_name(), time, rest});
    }
  }
}

std::string GrowthReporter::to_markdown() const {
  std::string result = "| benchmark | ms | |\n|---|---|---|\n";
  for (const Row& row : rows_) {
    result += fmt::format("| {} | {:.3f} | {} |\n", row.name, row.ms, row.rest);
  }
  result += "\n| growth with the number of nodes | fitted exponent | Google Benchmark's fit |\n";
  result += "|---|---|---|\n";
  for (const auto& [name, family] : families_) {
    if (family.points.size() < 2) continue;
    result += fmt::format("| {} | {:.2f} | {} |\n", name, exponent(family.points), family.big_o);
  }
  return result;
}

}  // namespace deformlab
