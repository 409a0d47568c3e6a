#include "experiments/benchmarks/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/commands/environment.h"

namespace deformlab {
namespace {

std::string row_of(const Measurement& m) { return m.scenario + ", against " + m.against; }

std::string ratio_of(const Measurement& m) {
  const Spread ratio = m.ratio();
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", ratio.median, ratio.least, ratio.most);
}

std::string ratio_table(const std::vector<Measurement>& all, const std::string& unit) {
  std::set<int> sizes;
  std::vector<std::string> rows;
  for (const Measurement& m : all) {
    if (m.unit != unit) continue;
    sizes.insert(m.size);
    if (std::ranges::find(rows, row_of(m)) == rows.end()) rows.push_back(row_of(m));
  }
  if (rows.empty()) return {};
  std::string head = "| times as fast |", line = "|---|";
  for (const int size : sizes) {
    head += fmt::format(" {} {} |", size, unit);
    line += "---|";
  }
  std::string text = head + "\n" + line + "\n";
  for (const std::string& row : rows) {
    text += "| " + row + " |";
    for (const int size : sizes) {
      const auto found = std::ranges::find_if(all, [&](const Measurement& m) {
        return m.unit == unit && m.size == size && row_of(m) == row;
      });
      text += found == all.end() ? " |" : " " + ratio_of(*found) + " |";
    }
    text += "\n";
  }
  return text + "\n";
}

std::string figures_of(const Measurement::Side& side) {
  std::string text = fmt::format("{} | {:.4g}", side.way, spread(side.ms).median);
  for (const auto& [name, values] : side.parts) {
    text += fmt::format("; {} {:.4g}", name, spread(values).median);
  }
  if (const auto& ms = side.alone_ms; !ms.empty()) {
    text += fmt::format("; alone: p50 {:.4g}, p95 {:.4g}, p99 {:.4g} of {}", quantile(ms, 0.5),
                        quantile(ms, 0.95), quantile(ms, 0.99), ms.size());
  }
  if (side.last.status.empty()) return text + " | | | ";
  return text +
         fmt::format(" | {} | {:.9g} | {}", side.last.steps, side.last.cost, side.last.status);
}

nlohmann::ordered_json to_json(const Measurement::Side& side) {
  nlohmann::ordered_json json = {{"settings", side.way}, {"ms", side.ms}};
  for (const auto& [name, values] : side.parts) json["parts_ms"][name] = values;
  if (!side.alone_ms.empty()) json["alone_ms"] = side.alone_ms;
  if (!side.last.status.empty()) {
    json["status"] = side.last.status;
    json["steps"] = side.last.steps;
    json["cost"] = side.last.cost;
    json["blas"] = side.last.blas;
  }
  return json;
}

}  // namespace

std::string to_markdown(const std::vector<Measurement>& all) {
  std::string text = ratio_table(all, "nodes") + ratio_table(all, "vertices");
  text +=
      "| scenario | size | ours | ms | steps | F | status | theirs | ms | steps | F | status | "
      "pairs |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Measurement& m : all) {
    text += fmt::format("| {} | {} | {} | {} | {} |\n", row_of(m), m.size, figures_of(m.ours),
                        figures_of(m.theirs), m.ours.ms.size());
  }
  return text;
}

nlohmann::ordered_json to_json(const std::vector<Measurement>& all) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Measurement& m : all) {
    const Spread ratio = m.ratio();
    json.push_back({{"scenario", m.scenario},
                    {"against", m.against},
                    {m.unit, m.size},
                    {"ratio", ratio.median},
                    {"ratio_least", ratio.least},
                    {"ratio_most", ratio.most},
                    {"same_minimum", m.same_minimum()},
                    {"ours", to_json(m.ours)},
                    {"theirs", to_json(m.theirs)}});
  }
  return json;
}

std::string environment_markdown() {
  std::string text;
  const auto all = environment();
  if (all.at("commit").ends_with("-dirty")) {
    text +=
        "**The code was changed after the commit that is named below, so nobody can repeat these "
        "measurements. Commit the changes and measure again.**\n\n";
  }
  for (const auto& [name, value] : all) text += fmt::format("- {}: {}\n", name, value);
  return text;
}

}  // namespace deformlab
