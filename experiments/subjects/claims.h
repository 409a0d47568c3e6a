#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/config/config_node.h"
#include "experiments/measure/measurements.h"
#include "geometry/core/options.h"

namespace deformlab {

/// How the values of several runs become one: the worst of them, their mean, (max − min) / |mean|,
/// max − min, or the p with which the metric grows as (another metric)ᵖ.
enum class ClaimOver { kWorst, kMean, kSpread, kRange, kExponent };
constexpr auto names_of(ClaimOver) {
  using enum ClaimOver;
  return std::to_array<EnumName<ClaimOver>>({{kWorst, "worst"},
                                             {kMean, "mean"},
                                             {kSpread, "spread"},
                                             {kRange, "range"},
                                             {kExponent, "exponent"}});
}

/// A statement of a config about measurements, which its run checks.
struct Claim {
  std::string name;
  std::string says;
  std::string measure, per, against;
  ConfigNode where, versus;
  ClaimOver over = ClaimOver::kWorst;
  std::optional<double> at_least, at_most, equals;
  double within = 0;
  std::string known;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("name", o.name, "The name of the claim");
    visit("says", o.says, "The statement, quoted from the paper where it is the paper's");
    visit.required("measure", o.measure, "The name of the metric that the claim is about");
    visit("per", o.per, "Another metric of the same run, by which the first is divided");
    visit("where", o.where,
          "The runs of a sweep that the claim is about: a map of dotted keys to a value or a list "
          "of values");
    visit("versus", o.versus,
          "Other runs of the sweep; the claim is then about the ratio of the two means");
    visit("over", o.over,
          "How the values of several runs become one: the worst of them, their mean, "
          "(max − min) / |mean|, max − min, or the p with which the metric grows as (another "
          "metric)ᵖ");
    visit("against", o.against, "The other metric of an exponent");
    visit("at_least", o.at_least, "The smallest value that is expected");
    visit("at_most", o.at_most, "The largest value that is expected");
    visit("equals", o.equals, "The value that is expected, up to `within`");
    visit.range("within", o.within, {.min = 0},
                "The relative deviation from `equals` that is allowed");
    visit("known", o.known,
          "The reason why the claim falls short, where it is known; the run then does not fail");
  }
};

/// What claims use of one run of a sweep: its settings and its metrics.
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

/// Whether the settings of a run are those of a map, which has dotted keys and their values, or
/// lists of values of which one must match.
bool matches(const MeasuredRun& run, const ConfigNode& filter);

/// Throws InputError if a claim expects nothing, or something impossible.
void check_form(const Claim& claim);

/// Throws InputError as check_form does, and if the claim names runs or a metric that do not exist.
ClaimResult check(const Claim& claim, const std::vector<MeasuredRun>& runs);

}  // namespace deformlab
