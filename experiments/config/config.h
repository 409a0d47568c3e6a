#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "energies/catalog.h"
#include "experiments/config/config_node.h"
#include "geometry/core/options.h"

/// Reading, writing and help of options structs, which describe their fields as
/// geometry/core/options.h says. A field may be bool, int, std::int64_t, std::uint64_t, double, an
/// enumeration with names, std::string, std::filesystem::path, Eigen::Vector3d,
/// std::map<std::string, double>, the settings of energy terms by their names, ConfigNode (which is
/// kept as it is), a struct with fields, a std::map of such structs by name, or a std::vector or
/// std::optional of these.
namespace deformlab {

/// One line of help. Fields of nested structs have dotted names. Those in lists have names like
/// `list[].name`, and those in maps have names like `map.NAME.name`.
struct FieldHelp {
  std::string name;
  std::string value;    ///< the default as YAML, or "required"
  std::string meaning;  ///< what it does, and what is allowed
};

/// Throws InputError at the first key of the map that is not known; `what` is what the message
/// calls it ("key", "energy"), and `prefix` the dotted path of the map with a dot at its end.
void check_keys(const ConfigNode& map, const std::vector<std::string>& known,
                const std::string& what = "key", const std::string& prefix = "");

/// Throws InputError: the value `name` is not what was expected.
[[noreturn]] void throw_wrong_value(const ConfigNode& node, const std::string& name,
                                    const std::string& expected);

/// Help as text, one field a line, in columns.
std::string to_text(const std::vector<FieldHelp>& fields);

// Reading: each overload replaces `value` by the content of the node, or throws InputError. `name`
// is the dotted name for messages. A map of numbers is merged into the old value, so that setting
// one weight keeps the defaults of the others.
void read_value(const ConfigNode& node, const std::string& name, bool& value);
void read_value(const ConfigNode& node, const std::string& name, int& value);
void read_value(const ConfigNode& node, const std::string& name, std::int64_t& value);
void read_value(const ConfigNode& node, const std::string& name, std::uint64_t& value);
void read_value(const ConfigNode& node, const std::string& name, double& value);
void read_value(const ConfigNode& node, const std::string& name, std::string& value);
void read_value(const ConfigNode& node, const std::string& name, std::filesystem::path& value);
void read_value(const ConfigNode& node, const std::string& name, Eigen::Vector3d& value);
void read_value(const ConfigNode& node, const std::string& name,
                std::map<std::string, double>& value);
void read_value(const ConfigNode& node, const std::string& name, ConfigNode& value);
/// Reads settings by the names of energy terms. A number is the weight; a map has `weight` and the
/// options that the term declares. They are merged into the old settings.
void read_value(const ConfigNode& node, const std::string& name,
                std::map<std::string, TermSettings>& value);

/// Reads a text that must be one of the names, and returns its index among them.
std::size_t read_name(const ConfigNode& node, const std::string& name,
                      const std::vector<std::string>& names);

template <NamedEnum E>
void read_value(const ConfigNode& node, const std::string& name, E& value) {
  value = names_of(E{})[read_name(node, name, all_names<E>())].value;
}

/// The error with the dotted path `prefix` before the field, and with the line of the field's value
/// in `map`, from which the options were read.
InputError located(const OptionError& error, const ConfigNode& map, const std::string& prefix = "");

/// Calls action(). If it throws an OptionError, adds the line of the config.
template <class Action>
decltype(auto) with_lines_of(const ConfigNode& root, Action&& action) {
  try {
    return action();
  } catch (const OptionError& error) {
    throw located(error, root);
  }
}

// Writing: each overload makes the node from which the same value is read.
ConfigNode to_node(bool value);
ConfigNode to_node(int value);
ConfigNode to_node(std::int64_t value);
ConfigNode to_node(std::uint64_t value);
ConfigNode to_node(double value);
ConfigNode to_node(const std::string& value);
ConfigNode to_node(const std::filesystem::path& value);
ConfigNode to_node(const Eigen::Vector3d& value);
ConfigNode to_node(const std::map<std::string, double>& value);
ConfigNode to_node(const ConfigNode& value);
ConfigNode to_node(const std::map<std::string, TermSettings>& value);

/// One line of help for each option that a term of the catalog declares: `name.TERM.OPTION`.
void append_term_options(const std::string& name, std::vector<FieldHelp>& fields);

template <NamedEnum E>
ConfigNode to_node(E value) {
  return to_node(std::string(name_of(value)));
}
template <HasFields T>
ConfigNode to_node(const T& value);
template <class T>
ConfigNode to_node(const std::vector<T>& value);
template <class T>
ConfigNode to_node(const std::optional<T>& value);
template <HasFields T>
ConfigNode to_node(const std::map<std::string, T>& value);

/// Lists the fields that a struct describes.
class FieldDescriber : public FieldVisitor<FieldDescriber> {
 public:
  explicit FieldDescriber(std::string prefix = "") : prefix_(std::move(prefix)) {}

  template <class T>
  void field(const Field& field, const T& value);

  std::vector<FieldHelp> fields;

 private:
  void add(const std::string& name, const std::string& value, const Field& field,
           const std::vector<std::string>& names);

  std::string prefix_;
};

/// Collects the names of one struct, without those nested in it.
struct FieldNames : FieldVisitor<FieldNames> {
  std::vector<std::string> names;

  void field(const Field& field, const auto&) { names.emplace_back(field.name); }
};

/// Reads the fields of a struct from a map.
class FieldReader : public FieldVisitor<FieldReader> {
 public:
  FieldReader(const ConfigNode& map, std::string prefix) : map_(map), prefix_(std::move(prefix)) {}

  template <class T>
  void field(const Field& field, T& value) {
    const ConfigNode* node = field.required ? &get(field.name) : map_.find(field.name);
    if (node == nullptr) return;
    const std::string name = prefix_ + field.name;
    if constexpr (std::same_as<T, std::string>) {
      if (!field.names.empty()) read_name(*node, name, field.names);
    }
    read_value(*node, name, value);
    if constexpr (!HasFields<T>) check(field, value);  // a struct checked its fields as it was read
  }

 private:
  const ConfigNode& get(const char* name) const;  ///< throws InputError if the key is missing

  template <class T>
  void check(const Field& field, const T& value) const {
    try {
      check_value(field, field.name, value);
    } catch (const OptionError& error) {
      throw located(error, map_, prefix_);
    }
  }

  const ConfigNode& map_;
  std::string prefix_;
};

/// Writes the fields of a struct into a map.
class FieldWriter : public FieldVisitor<FieldWriter> {
 public:
  FieldWriter() { map.kind = ConfigNode::Kind::kMap; }

  template <class T>
  void field(const Field& field, const T& value) {
    add(field.name, to_node(value));
  }
  void add(const std::string& name, ConfigNode node);

  ConfigNode map;
};

void check_map(const ConfigNode& node, const std::string& name);
void check_list(const ConfigNode& node, const std::string& name);

template <HasFields T>
void read_value(const ConfigNode& node, const std::string& name, T& value) {
  check_map(node, name);
  FieldNames known;
  T::fields(value, known);
  const std::string prefix = name.empty() ? "" : name + ".";
  // The keys come first, because a misspelt name is the usual cause of a missing one.
  check_keys(node, known.names, "key", prefix);
  FieldReader reader(node, prefix);
  T::fields(value, reader);
}

template <class T>
void read_value(const ConfigNode& node, const std::string& name, std::vector<T>& value) {
  check_list(node, name);
  value.clear();
  for (const ConfigNode& child : node.children) {
    T element{};
    read_value(child, name + "[" + std::to_string(value.size()) + "]", element);
    value.push_back(std::move(element));
  }
}

template <class T>
void read_value(const ConfigNode& node, const std::string& name, std::optional<T>& value) {
  value.reset();
  if (node.kind != ConfigNode::Kind::kNull) read_value(node, name, value.emplace());
}

template <HasFields T>
void read_value(const ConfigNode& node, const std::string& name, std::map<std::string, T>& value) {
  check_map(node, name);
  for (const ConfigNode& child : node.children) {
    read_value(child, name + "." + child.key, value[child.key]);
  }
}

template <HasFields T>
ConfigNode to_node(const T& value) {
  FieldWriter writer;
  T::fields(value, writer);
  return std::move(writer.map);
}

template <class T>
ConfigNode to_node(const std::vector<T>& value) {
  ConfigNode list;
  list.kind = ConfigNode::Kind::kList;
  for (const auto& element : value) list.children.push_back(to_node(static_cast<T>(element)));
  return list;
}

template <class T>
ConfigNode to_node(const std::optional<T>& value) {
  return value ? to_node(*value) : ConfigNode{};
}

template <HasFields T>
ConfigNode to_node(const std::map<std::string, T>& value) {
  FieldWriter writer;
  for (const auto& [name, element] : value) writer.add(name, to_node(element));
  return std::move(writer.map);
}

template <class T>
struct ElementOf {
  using type = T;
  static constexpr const char* kSuffix = "";
};
template <class T>
struct ElementOf<std::vector<T>> : ElementOf<T> {
  static constexpr const char* kSuffix = "[]";
};
template <class T>
struct ElementOf<std::optional<T>> : ElementOf<T> {};
template <HasFields T>
struct ElementOf<std::map<std::string, T>> : ElementOf<T> {
  static constexpr const char* kSuffix = ".NAME";
};

template <class T>
void FieldDescriber::field(const Field& field, const T& value) {
  using Element = typename ElementOf<T>::type;
  const std::string full = prefix_ + field.name;
  if constexpr (HasFields<Element>) {
    const std::string owner = full + ElementOf<T>::kSuffix;
    add(owner, "", field, {});
    FieldDescriber nested(owner + ".");
    if constexpr (std::same_as<Element, T>) {
      T::fields(value, nested);
    } else {
      const Element defaults{};
      Element::fields(defaults, nested);
    }
    fields.insert(fields.end(), nested.fields.begin(), nested.fields.end());
  } else {
    std::vector<std::string> names = field.names;
    if constexpr (NamedEnum<Element>) names = all_names<Element>();
    add(full, to_yaml_line(to_node(value)), field, names);
    if constexpr (std::same_as<T, std::map<std::string, TermSettings>>) {
      append_term_options(full, fields);
    }
  }
}

/// Reads `root` into the defaults of T. Throws InputError (naming the line, or the override) for an
/// unknown key, a missing one, or a value of another type or out of range.
template <HasFields T>
T read_config(const ConfigNode& root) {
  T options{};
  read_value(root, "", options);
  return options;
}

/// Names, defaults and meanings of all fields of T.
template <HasFields T>
std::vector<FieldHelp> describe() {
  FieldDescriber describer;
  const T defaults{};
  T::fields(defaults, describer);
  return std::move(describer.fields);
}

}  // namespace deformlab
