#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace deformlab {

/// One cell of the table of speeds: our default against another way to the same end, in one run.
struct Duel {
  std::string row;           ///< what is compared
  int nodes = 0;             ///< of the graph
  double target = 0;         ///< the ratio that is aimed at; 0: none
  std::string ours, theirs;  ///< who, with all settings that are not defaults
  std::string our_status, their_status;
  std::size_t our_steps = 0, their_steps = 0;
  double our_cost = 0, their_cost = 0;
  std::vector<double> our_ms, their_ms;  ///< in turns

  double ratio() const;  ///< of the medians, theirs over ours
  bool same_minimum() const;
};

/// The reference scene on a graph of so many nodes, in five ways. `repetitions` of each pair, but
/// what takes many seconds is measured once.
std::vector<Duel> duels(int nodes, int repetitions);

/// A Markdown table: a row for what is compared, a column for each number of nodes; and what each
/// figure was measured with.
std::string to_markdown(const std::vector<Duel>& all);
/// The same with all figures.
nlohmann::ordered_json to_json(const std::vector<Duel>& all);

}  // namespace deformlab
