#pragma once

#include <concepts>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "geometry/core/enum_names.h"
#include "geometry/core/error.h"

/// Options are plain structs. A static function `fields` describes each field once, and from this
/// description follow the reading of configs, help, and `check_options`:
///
///   struct GraphOptions {
///     int nodes = 300;
///     EdgeWeights alpha = EdgeWeights::kUniform;
///     template <class Self, class Visit>
///     static void fields(Self& o, Visit&& visit) {
///       visit.range("nodes", o.nodes, {.min = 1}, "Number of nodes of the graph");
///       visit("alpha", o.alpha, "Weight of an edge in Eq. 7");
///     }
///   };
///
/// A description is a phrase that a new user understands. That of a number ends with the unit in
/// brackets, [length], [degree], [pixel], [s]; a count or a ratio has none.
namespace deformlab {

/// The finite numbers that an option may have.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool exclusive_min = false;
  bool exclusive_max = false;

  bool contains(double value) const;
  /// "1 to 16", "at least 1", "greater than 0 and at most 1"; empty where all numbers are allowed.
  std::string text() const;
};

/// The value of an option cannot be used. Code that reads an options struct names the field as it
/// is called in that struct. Code that owns the struct as a member adds the member's name, by
/// `inside_option`, so that the error finally names the path of the field: "graph.nodes".
class OptionError : public InputError {
 public:
  /// The message is "FIELD is VALUE" and the explanation, which begins with "; " or ", ".
  OptionError(std::string field, std::string value, std::string explanation);

  const std::string& field() const { return field_; }
  const std::string& value() const { return value_; }
  const std::string& explanation() const { return explanation_; }
  OptionError inside(std::string_view owner) const;

 private:
  std::string field_, value_, explanation_;
};

/// Calls action(). Where it throws an OptionError, `owner` and a dot are put before the field.
template <class Action>
decltype(auto) inside_option(std::string_view owner, Action&& action) {
  try {
    return action();
  } catch (const OptionError& error) {
    throw error.inside(owner);
  }
}

/// The description of one field of an options struct.
struct Field {
  const char* name;
  const char* meaning;
  Range range = {};                     ///< of a number, or of each number in a container
  std::vector<std::string> names = {};  ///< allowed values of a std::string; empty allows all
  bool required = false;                ///< a config must give it
};

/// Base class of visitors of `fields`. All of its functions call derived.field(Field, value).
template <class Derived>
class FieldVisitor {
 public:
  template <class T>
  void operator()(const char* name, T& value, const char* meaning) {
    self().field({name, meaning}, value);
  }
  template <class T>
  void range(const char* name, T& value, const Range& range, const char* meaning) {
    self().field({name, meaning, range}, value);
  }
  /// A text that is one of an open set of names. For a closed set use an enumeration.
  template <class T>
  void choice(const char* name, T& value, std::vector<std::string> names, const char* meaning) {
    self().field({name, meaning, {}, std::move(names)}, value);
  }
  template <class T>
  void required(const char* name, T& value, const char* meaning) {
    self().field({.name = name, .meaning = meaning, .required = true}, value);
  }
  template <class T>
  void required(const char* name, T& value, const Range& range, const char* meaning) {
    self().field({.name = name, .meaning = meaning, .range = range, .required = true}, value);
  }

 private:
  Derived& self() { return static_cast<Derived&>(*this); }
};

class OptionChecker;

template <class T>
concept HasFields = requires(const T& options, OptionChecker& visit) {
  T::fields(options, visit);
};

/// Throws OptionError where a number is not in the range.
void check_number(const std::string& field, double value, const Range& range);
/// Throws OptionError where a text is none of the names.
void check_name(const std::string& field, const std::string& value,
                const std::vector<std::string>& names);

/// Throws OptionError at the first value of `options` that its description does not allow.
template <HasFields T>
void check_options(const T& options);

template <class T>
inline constexpr bool kIsVector = false;
template <class E>
inline constexpr bool kIsVector<std::vector<E>> = true;

/// Checks the value of one field in the same way.
template <class T>
void check_value(const Field& field, const std::string& name, const T& value) {
  if constexpr (std::integral<T> || std::floating_point<T>) {
    check_number(name, static_cast<double>(value), field.range);
  } else if constexpr (std::same_as<T, std::string>) {
    check_name(name, value, field.names);
  } else if constexpr (HasFields<T>) {
    inside_option(name, [&] { check_options(value); });
  } else if constexpr (requires { value.has_value(); }) {
    if (value) check_value(field, name, *value);
  } else if constexpr (requires { typename T::mapped_type; }) {
    for (const auto& [key, element] : value) check_value(field, name + "." + key, element);
  } else if constexpr (kIsVector<T>) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      check_value(field, name + "[" + std::to_string(i) + "]", value[i]);
    }
  }
}

class OptionChecker : public FieldVisitor<OptionChecker> {
 public:
  template <class T>
  void field(const Field& field, const T& value) {
    check_value(field, field.name, value);
  }
};

template <HasFields T>
void check_options(const T& options) {
  OptionChecker checker;
  T::fields(options, checker);
}

}  // namespace deformlab
