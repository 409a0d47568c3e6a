#include "experiments/subjects/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "experiments/config/suggest.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

// Whether a value is the expected one, which may itself be a list, or is one of a list of values.
bool is_wanted(const std::string& value, const ConfigNode& wanted) {
  if (value == to_yaml_line(wanted)) return true;
  return wanted.kind == ConfigNode::Kind::kList &&
         std::any_of(wanted.children.begin(), wanted.children.end(),
                     [&](const ConfigNode& one) { return value == to_yaml_line(one); });
}

double metric(const Metrics& metrics, const Claim& claim, const std::string& measure) {
  const auto found = metrics.find(measure);
  if (found != metrics.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [name, value] : metrics) known.push_back(name);
  throw InputError(fmt::format("claim '{}': unknown measure {}; {}", claim.name, quote(measure),
                               known_names(measure, known)));
}

double measure(const Metrics& metrics, const Claim& claim) {
  const double value = metric(metrics, claim, claim.measure);
  return claim.per.empty() ? value : value / metric(metrics, claim, claim.per);
}

std::vector<double> values(const Claim& claim, const ConfigNode& filter,
                           const std::vector<MeasuredRun>& runs) {
  std::vector<double> result;
  for (const MeasuredRun& run : runs) {
    if (matches(run, filter)) result.push_back(measure(run.metrics, claim));
  }
  if (result.empty()) {
    throw InputError(fmt::format("claim '{}': no run has {}", claim.name, to_yaml_line(filter)));
  }
  return result;
}

double mean(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x;
  return sum / static_cast<double>(v.size());
}

// The slope of log(measure) over log(against), by least squares.
double exponent(const Claim& claim, const std::vector<MeasuredRun>& runs) {
  std::vector<double> x, y;
  for (const MeasuredRun& run : runs) {
    if (!matches(run, claim.where)) continue;
    x.push_back(std::log(metric(run.metrics, claim, claim.against)));
    y.push_back(std::log(measure(run.metrics, claim)));
  }
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean(x)) * (x[i] - mean(x));
    xy += (x[i] - mean(x)) * (y[i] - mean(y));
  }
  return xy / xx;
}

// By how much a value exceeds what is allowed. The largest excess is the worst.
double excess(const Claim& claim, double x) {
  if (!std::isfinite(x)) return INFINITY;
  double result = -INFINITY;
  if (claim.at_least) result = std::max(result, *claim.at_least - x);
  if (claim.at_most) result = std::max(result, x - *claim.at_most);
  if (claim.equals) {
    result = std::max(result, std::abs(x - *claim.equals) - claim.within * std::abs(*claim.equals));
  }
  return result;
}

double measured(const Claim& claim, const std::vector<MeasuredRun>& runs) {
  const std::vector<double> v = values(claim, claim.where, runs);
  if (!claim.versus.children.empty()) return mean(v) / mean(values(claim, claim.versus, runs));
  if (claim.over == ClaimOver::kMean) return mean(v);
  if (claim.over == ClaimOver::kExponent) return exponent(claim, runs);
  if (claim.over == ClaimOver::kSpread || claim.over == ClaimOver::kRange) {
    const auto [low, high] = std::minmax_element(v.begin(), v.end());
    return (*high - *low) / (claim.over == ClaimOver::kRange ? 1 : std::abs(mean(v)));
  }
  return *std::max_element(v.begin(), v.end(),
                           [&](double a, double b) { return excess(claim, a) < excess(claim, b); });
}

std::string expected(const Claim& claim) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (claim.at_least) add("at least " + number(*claim.at_least));
  if (claim.at_most) add("at most " + number(*claim.at_most));
  if (claim.equals) {
    add(number(*claim.equals) +
        (claim.within > 0 ? " within " + number(100 * claim.within) + " %" : ""));
  }
  return text;
}

}  // namespace

bool matches(const MeasuredRun& run, const ConfigNode& filter) {
  return std::all_of(filter.children.begin(), filter.children.end(), [&](const ConfigNode& wanted) {
    return std::any_of(run.settings.begin(), run.settings.end(), [&](const auto& setting) {
      return setting.first == wanted.key && is_wanted(setting.second, wanted);
    });
  });
}

std::string ClaimResult::line() const {
  std::string text = "claim " + name + ": measured " + number(measured) + ", expected " + expected;
  text += holds ? " ok" : " falls short";
  if (!holds && !known.empty()) text += " (known: " + known + ")";
  return text;
}

void check_form(const Claim& claim) {
  const std::string whose = "claim '" + claim.name + "'";
  if (!claim.at_least && !claim.at_most && !claim.equals) {
    throw InputError(fmt::format("{} expects nothing: give at_least, at_most or equals", whose));
  }
  if ((claim.over == ClaimOver::kExponent) == claim.against.empty()) {
    throw InputError(
        fmt::format("{}: 'over: exponent' needs 'against', and nothing else does", whose));
  }
  for (const ConfigNode* filter : {&claim.where, &claim.versus}) {
    if (filter->kind == ConfigNode::Kind::kNull || filter->kind == ConfigNode::Kind::kMap) continue;
    throw InputError(
        fmt::format("{} ({}): 'where' and 'versus' are maps of keys and values, found {}", whose,
                    filter->where(), filter->found()));
  }
}

ClaimResult check(const Claim& claim, const std::vector<MeasuredRun>& runs) {
  check_form(claim);
  ClaimResult result{claim.name, claim.says, expected(claim), claim.known, 0, false};
  result.measured = measured(claim, runs);
  result.holds = excess(claim, result.measured) <= 0;
  return result;
}

}  // namespace deformlab
