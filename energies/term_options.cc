#include "energies/term_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr const char* kTypes[] = {"true or false", "a whole number", "a number", "text", "a path"};

std::string shown(const OptionValue& value) {
  return std::visit(
      [](const auto& v) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(v)>, std::filesystem::path>) {
          return v.string();
        } else {
          return fmt::format("{}", v);
        }
      },
      value);
}

// Converts a whole number to a number, and text to a path, but nothing else.
bool convert(OptionValue given, OptionValue& value) {
  if (std::holds_alternative<double>(value) && std::holds_alternative<int>(given)) {
    given = static_cast<double>(std::get<int>(given));
  } else if (std::holds_alternative<std::filesystem::path>(value) &&
             std::holds_alternative<std::string>(given)) {
    given = std::filesystem::path(std::get<std::string>(given));
  }
  if (given.index() != value.index()) return false;
  value = std::move(given);
  return true;
}

}  // namespace

void assign_option(const std::string& term, const OptionInfo& option, const OptionValues& values,
                   OptionValue& value) {
  const auto given = values.find(option.name);
  if (given == values.end()) return;
  if (!convert(given->second, value)) {
    throw InputError(fmt::format("energies.{}.{} is {}; it has to be {}", term, option.name,
                                 shown(given->second), kTypes[value.index()]));
  }
  const auto& allowed = option.allowed;
  if (!allowed.empty() && std::ranges::find(allowed, shown(value)) == allowed.end()) {
    throw InputError(fmt::format("energies.{}.{} is '{}'; it has to be one of {}", term,
                                 option.name, shown(value), fmt::join(allowed, ", ")));
  }
}

void check_option_names(const std::string& term, const std::vector<OptionInfo>& options,
                        const OptionValues& values) {
  for (const auto& [name, value] : values) {
    if (std::ranges::find(options, name, &OptionInfo::name) != options.end()) continue;
    std::vector<std::string> known{"weight"};
    for (const OptionInfo& option : options) known.push_back(option.name);
    throw InputError(fmt::format("unknown option energies.{}.{}; known: {}", term, name,
                                 fmt::join(known, ", ")));
  }
}

}  // namespace deformlab
