#include "experiments/config/suggest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "experiments/config/renamed_names.h"
#include "geometry/core/text.h"

namespace deformlab {

int edit_distance(std::string_view given, std::string_view known) {
  const std::string a = lower_case(given), b = lower_case(known);
  const std::size_t n = b.size();
  std::vector<int> before(n + 1), last(n + 1), row(n + 1);
  for (std::size_t j = 0; j <= n; ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      const bool same = a[i - 1] == b[j - 1];
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[n];
}

std::optional<std::string> nearest_name(std::string_view given,
                                        const std::vector<std::string>& known) {
  std::optional<std::string> nearest;
  int best = 0;
  for (const std::string& name : known) {
    // If more than a third of the letters differ, a suggestion misleads more than it helps.
    const int allowed = static_cast<int>(std::max(given.size(), name.size()) + 2) / 3;
    const int distance = edit_distance(given, name);
    if (distance > allowed || (nearest && distance >= best)) continue;
    nearest = name;
    best = distance;
  }
  return nearest;
}

std::string known_names(std::string_view given, const std::vector<std::string>& known,
                        std::string_view prefix) {
  const std::string_view moved = prefix.empty() ? "" : renamed(fmt::format("{}{}", prefix, given));
  if (!moved.empty()) return fmt::format("'{}{}' is called '{}' now", prefix, given, moved);
  const std::string_view today = renamed(given);
  if (std::find(known.begin(), known.end(), today) != known.end()) {
    return fmt::format("it is called '{}' now", today);
  }
  std::string text =
      fmt::format("known: {}", known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")));
  if (const auto nearest = nearest_name(given, known)) {
    text += fmt::format("; did you mean '{}'?", *nearest);
  }
  return text;
}

std::string quote(std::string_view text) {
  constexpr std::size_t kShown = 60;
  std::string shown(text.substr(0, kShown));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
  return "'" + shown + (text.size() > kShown ? "…'" : "'");
}

}  // namespace deformlab
