#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "experiments/benchmarks/duel.h"

namespace deformlab {
namespace {

template <class... Args>
std::string format(const char* pattern, Args... args) {
  char text[512];
  std::snprintf(text, sizeof text, pattern, args...);
  return text;
}

template <class Value, class Of>
std::vector<Value> distinct(const std::vector<Duel>& all, Of&& of) {
  std::vector<Value> result;
  for (const Duel& duel : all) {
    if (std::find(result.begin(), result.end(), of(duel)) == result.end()) {
      result.push_back(of(duel));
    }
  }
  return result;
}

double middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::string ratios(const std::vector<Duel>& all) {
  const auto sizes = distinct<int>(all, [](const Duel& d) { return d.nodes; });
  std::string text = "| times as fast, and the aim |";
  std::string line = "|---|";
  for (const int nodes : sizes) text += format(" %d nodes |", nodes), line += "---|";
  text += "\n" + line + "\n";
  for (const std::string& row : distinct<std::string>(all, [](const Duel& d) { return d.row; })) {
    text += "| " + row + " |";
    for (const int nodes : sizes) {
      for (const Duel& d : all) {
        if (d.row != row || d.nodes != nodes) continue;
        text += format(" %.0f", d.ratio());
        if (d.target > 0) {
          text += format(" (%.0f: %s)", d.target, d.ratio() >= d.target ? "ok" : "falls short");
        }
        text += " |";
      }
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::string to_markdown(const std::vector<Duel>& all) {
  std::string text = ratios(all);
  text +=
      "\n| | nodes | ours | ms | steps | F | theirs | ms | steps | F | status | runs |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Duel& d : all) {
    text += format("| %s | %d | %s | %.2f | %zu | %.9g ", d.row.c_str(), d.nodes, d.ours.c_str(),
                   middle(d.our_ms), d.our_steps, d.our_cost);
    text += format("| %s | %.1f | %zu | %.9g | %s, %s | %zu |\n", d.theirs.c_str(),
                   middle(d.their_ms), d.their_steps, d.their_cost, d.our_status.c_str(),
                   d.their_status.c_str(), d.their_ms.size());
  }
  return text;
}

nlohmann::ordered_json to_json(const std::vector<Duel>& all) {
  nlohmann::ordered_json json;
  for (const Duel& d : all) {
    nlohmann::ordered_json cell = {{"row", d.row}, {"nodes", d.nodes}, {"ratio", d.ratio()}};
    if (d.target > 0) cell["target"] = d.target;
    cell["ours"] = {{"settings", d.ours},
                    {"status", d.our_status},
                    {"steps", d.our_steps},
                    {"cost", d.our_cost},
                    {"ms", d.our_ms}};
    cell["theirs"] = {{"settings", d.theirs},
                      {"status", d.their_status},
                      {"steps", d.their_steps},
                      {"cost", d.their_cost},
                      {"ms", d.their_ms}};
    json.push_back(cell);
  }
  return json;
}

}  // namespace deformlab
