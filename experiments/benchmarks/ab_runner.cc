#include "experiments/benchmarks/ab_runner.h"

#include <algorithm>
#include <cmath>

namespace deformlab {
namespace {

constexpr double kSlow = 3000;  // [ms]

double run_once(const Way& way, Measurement::Side& side) {
  side.last = way.run();
  side.ms.push_back(side.last.ms);
  if (side.parts.empty()) {
    for (const auto& [name, value] : side.last.parts) side.parts.push_back({name, {}});
  }
  for (std::size_t i = 0; i < side.parts.size(); ++i) {
    side.parts[i].second.push_back(side.last.parts[i].second);
  }
  return side.last.ms;
}

}  // namespace

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {(values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back()};
}

double quantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(p * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

Spread Measurement::ratio() const {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < ours.ms.size(); ++i) ratios.push_back(theirs.ms[i] / ours.ms[i]);
  return spread(std::move(ratios));
}

bool Measurement::same_minimum() const {
  return std::abs(ours.last.cost - theirs.last.cost) <= 1e-6 * std::abs(ours.last.cost);
}

Measurement measure(const Scenario& scenario, int size, int repetitions) {
  const Way ours = scenario.ours(size), theirs = scenario.theirs(size);
  Measurement result{scenario.name, scenario.against, scenario.unit, size, {}, {}};
  result.ours.way = ours.name;
  result.theirs.way = theirs.name;
  ours.run();  // the first run fills the caches
  for (int i = 0; i < scenario.rounds * repetitions; ++i) {
    const double a = run_once(ours, result.ours), b = run_once(theirs, result.theirs);
    if (std::max(a, b) > kSlow) break;
  }
  for (int i = 0; i < scenario.alone * repetitions; ++i) {
    result.ours.alone_ms.push_back(ours.run().ms);
  }
  return result;
}

}  // namespace deformlab
