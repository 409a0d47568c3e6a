#include "geometry/core/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace deformlab {
namespace {

std::string message_of(const std::string& field, const std::string& value,
                       const std::string& explanation) {
  return fmt::format("{} is {}{}", field, value, explanation);
}

}  // namespace

bool Range::contains(double value) const {
  const bool above = exclusive_min ? value > min : value >= min;
  const bool below = exclusive_max ? value < max : value <= max;
  return std::isfinite(value) && above && below;
}

std::string Range::text() const {
  const bool has_min = std::isfinite(min), has_max = std::isfinite(max);
  if (has_min && has_max && !exclusive_min && !exclusive_max)
    return fmt::format("{} to {}", min, max);
  std::string text;
  if (has_min) text = fmt::format("{} {}", exclusive_min ? "greater than" : "at least", min);
  if (has_min && has_max) text += " and ";
  if (has_max) text += fmt::format("{} {}", exclusive_max ? "less than" : "at most", max);
  return text;
}

OptionError::OptionError(std::string field, std::string value, std::string explanation)
    : InputError(message_of(field, value, explanation)),
      field_(std::move(field)),
      value_(std::move(value)),
      explanation_(std::move(explanation)) {}

OptionError OptionError::inside(std::string_view owner) const {
  return {fmt::format("{}.{}", owner, field_), value_, explanation_};
}

void check_number(const std::string& field, double value, const Range& range) {
  if (range.contains(value)) return;
  const std::string allowed = range.text();
  throw OptionError(field, fmt::format("{}", value),
                    "; allowed: " + (allowed.empty() ? "finite numbers" : allowed));
}

void check_name(const std::string& field, const std::string& value,
                const std::vector<std::string>& names) {
  if (names.empty() || std::find(names.begin(), names.end(), value) != names.end()) return;
  throw OptionError(field, fmt::format("'{}'", value),
                    fmt::format("; known: {}", fmt::join(names, ", ")));
}

}  // namespace deformlab
