#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace deformlab {

/// One value of an enumeration and the name that configs, help, metrics and messages show for it.
template <class E>
struct EnumName {
  E value;
  std::string_view name;
};

/// An enumeration whose names are declared once, beside it, in a function that is found by the
/// enumeration's own namespace:
///
///   enum class EdgeWeights { kUniform, kLength };
///   constexpr auto names_of(EdgeWeights) {
///     using enum EdgeWeights;
///     return std::to_array<EnumName<EdgeWeights>>({{kUniform, "uniform"}, {kLength, "length"}});
///   }
template <class E>
concept NamedEnum = std::is_enum_v<E> && requires(E value) {
  names_of(value).begin()->name;
};

/// The name of a value; "unnamed" for a number that is no value of the enumeration.
template <NamedEnum E>
constexpr std::string_view name_of(E value) {
  for (const auto& entry : names_of(value)) {
    if (entry.value == value) return entry.name;
  }
  return "unnamed";
}

/// The value of a name, or nothing where no value has it.
template <NamedEnum E>
constexpr std::optional<E> value_of(std::string_view name) {
  for (const auto& entry : names_of(E{})) {
    if (entry.name == name) return entry.value;
  }
  return {};
}

template <NamedEnum E>
std::ostream& operator<<(std::ostream& out, E value) {
  return out << name_of(value);
}

/// All names, in the order in which they are declared.
template <NamedEnum E>
std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const auto& entry : names_of(E{})) names.emplace_back(entry.name);
  return names;
}

}  // namespace deformlab
