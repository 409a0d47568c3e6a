#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "geometry/core/options.h"

namespace deformlab {

/// The value of an option of a term. A file's path may be given as text.
using OptionValue = std::variant<bool, int, double, std::string, std::filesystem::path>;
using OptionValues = std::map<std::string, OptionValue>;

/// One option of a term, as the `fields` of its Options describe it.
struct OptionInfo {
  std::string name;
  OptionValue value;  ///< the default; its type is that of the option
  std::string meaning;
  std::vector<std::string> allowed{};  ///< the names of a choice; empty for other options
};

/// Replaces `value` by what `values` holds under the name of the option. Throws InputError if that
/// is of another type, or none of the allowed names. `term` is for the message.
void assign_option(const std::string& term, const OptionInfo& option, const OptionValues& values,
                   OptionValue& value);

/// Throws InputError for a value whose name is not that of an option.
void check_option_names(const std::string& term, const std::vector<OptionInfo>& options,
                        const OptionValues& values);

/// A term that has numbers, names or files of its own declares them as every options struct does:
///
///   struct Options {
///     double target = 1;
///     std::filesystem::path measured;
///     template <class Self, class Visit>
///     static void fields(Self& o, Visit&& visit) {
///       visit("target", o.target, "volume that a node keeps, of that at rest");
///       visit("measured", o.measured, "file of measured volumes, one a node");
///     }
///   };
///   static Terms<Volume> over(const GraphContext& context, const Options& options);
///
/// A config sets them beside the weight, `energies: {volume: {weight: 1, target: 0.9}}`, and `help`
/// and `list` show them. A field may have the types of OptionValue; ranges and choices are declared
/// as geometry/core/options.h says.
template <class Term>
concept HasOptions = requires {
  typename Term::Options;
};

/// A visitor for `fields` that calls `use(option, value)` for each field.
template <class Use>
class OptionVisitor : public FieldVisitor<OptionVisitor<Use>> {
 public:
  explicit OptionVisitor(Use use) : use_(std::move(use)) {}
  void field(const Field& field, auto& value) {
    use_(OptionInfo{field.name, value, field.meaning, field.names}, value);
  }

 private:
  Use use_;
};

/// The options of a term, with their defaults.
template <class Options>
std::vector<OptionInfo> describe_options() {
  std::vector<OptionInfo> result;
  const Options defaults{};
  OptionVisitor visit([&](OptionInfo option, const auto&) { result.push_back(std::move(option)); });
  Options::fields(defaults, visit);
  return result;
}

/// The options with some of them replaced by values. Throws InputError as assign_option does, and
/// for a number that is not in its range.
template <class Options>
Options make_options(const std::string& term, const OptionValues& values) {
  Options options{};
  OptionVisitor visit([&](const OptionInfo& option, auto& field) {
    OptionValue value = option.value;
    assign_option(term, option, values, value);
    field = std::get<std::remove_cvref_t<decltype(field)>>(std::move(value));
  });
  Options::fields(options, visit);
  inside_option(term, [&] { check_options(options); });
  return options;
}

}  // namespace deformlab
