#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/config/config_node.h"
#include "experiments/measure/measurements.h"

namespace deformlab {

/// A statement about measurements that a config carries, and that its run checks.
struct Claim {
  std::string name;
  std::string says;
  std::string measure, per, against;
  ConfigNode where, versus;
  std::string over = "worst";
  std::optional<double> at_least, at_most, equals;
  double within = 0;
  std::string known;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("name", o.name, "what the claim is called");
    visit("says", o.says, "the statement, quoted from the paper where it is the paper's");
    visit.required("measure", o.measure, "name of a metric");
    visit("per", o.per, "another metric of the same run, by which it is divided");
    visit(
        "where", o.where,
        "the runs of a sweep that it speaks of: dotted keys, and their value or a list of values");
    visit("versus", o.versus, "other runs: what is measured is then the ratio of the two means");
    visit.choice("over", o.over, {"worst", "mean", "spread", "range", "exponent"},
                 "several runs: the worst of them, their mean, (max − min) / |mean|, max − min, or "
                 "the p with which it grows as (another metric)ᵖ");
    visit("against", o.against, "exponent: the other metric");
    visit("at_least", o.at_least, "smallest value that is expected");
    visit("at_most", o.at_most, "largest value that is expected");
    visit("equals", o.equals, "value that is expected, up to `within`");
    visit("within", o.within, "relative deviation from `equals` that is allowed");
    visit("known", o.known, "why it falls short, where that is known: then it fails nothing");
  }
};

/// One run of a sweep as claims see it: what was set, and what came out.
struct MeasuredRun {
  std::vector<std::pair<std::string, std::string>> settings;  ///< dotted key, value as YAML
  Metrics metrics;
};

struct ClaimResult {
  std::string name, says, expected, known;
  double measured = 0;
  bool holds = false;

  /// `claim NAME: measured X, expected … ok`, or `falls short`.
  std::string line() const;
};

/// Whether a run was set as a map of dotted keys says: to their values, or to one of a list of
/// them.
bool matches(const MeasuredRun& run, const ConfigNode& filter);

/// Throws InputError where a claim expects nothing, or in a way that cannot hold.
void check_form(const Claim& claim);

/// Throws InputError as check_form does, or where the claim names runs or a metric that do not
/// exist.
ClaimResult check(const Claim& claim, const std::vector<MeasuredRun>& runs);

}  // namespace deformlab
