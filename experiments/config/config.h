#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "energies/catalog.h"
#include "experiments/config/config_node.h"

/// An options struct describes its fields once, in whatever layer it lives and without this header:
///
///   struct GraphOptions {
///     int nodes = 300;
///     std::string weights = "linear";
///     template <class Self, class Visit>
///     static void fields(Self& o, Visit&& visit) {
///       visit("nodes", o.nodes, "number of graph nodes");
///       visit.choice("weights", o.weights, {"linear", "uniform"}, "k-nearest-node weights");
///     }
///   };
///
/// `visit.required(...)` is a field that a config must give. From the description follow
/// read_config, to_node (and with to_yaml the resolved config) and describe.
/// A field may be bool, int, std::uint64_t, double, std::string, std::filesystem::path,
/// Eigen::Vector3d, std::map<std::string, double>, the settings of energy terms by their names,
/// ConfigNode (kept raw), a struct with fields, a
/// std::map of such structs by name, or a std::vector or std::optional of these; `choice` takes a
/// std::string or an enumeration.
namespace deformlab {

/// One line of help. Fields of nested structs have dotted names, those in lists `list[].name`,
/// those in maps by name `map.NAME.name`.
struct FieldHelp {
  std::string name;
  std::string value;  ///< the default as YAML, or "required"
  std::string meaning;
};

/// Throws InputError at the first key of the map that is not known; `what` is what the message
/// calls it ("key", "energy").
void check_keys(const ConfigNode& map, const std::vector<std::string>& known,
                const std::string& what = "key");

/// Throws InputError: the value `name` is not what was expected.
[[noreturn]] void throw_wrong_value(const ConfigNode& node, const std::string& name,
                                    const std::string& expected);

/// Help as text, one field a line, in columns.
std::string to_text(const std::vector<FieldHelp>& fields);

// Reading: each overload replaces `value` by what the node holds or throws InputError; `name` is
// the dotted name for messages. A map of numbers is merged into the one that is there, so that
// naming one weight keeps the defaults of the others.
void read_value(const ConfigNode& node, const std::string& name, bool& value);
void read_value(const ConfigNode& node, const std::string& name, int& value);
void read_value(const ConfigNode& node, const std::string& name, std::uint64_t& value);
void read_value(const ConfigNode& node, const std::string& name, double& value);
void read_value(const ConfigNode& node, const std::string& name, std::string& value);
void read_value(const ConfigNode& node, const std::string& name, std::filesystem::path& value);
void read_value(const ConfigNode& node, const std::string& name, Eigen::Vector3d& value);
void read_value(const ConfigNode& node, const std::string& name,
                std::map<std::string, double>& value);
void read_value(const ConfigNode& node, const std::string& name, ConfigNode& value);
/// By the names of energy terms: a number is the weight, a map holds `weight` and the options that
/// the term declares. Values are merged into those that are there.
void read_value(const ConfigNode& node, const std::string& name,
                std::map<std::string, TermSettings>& value);

/// Position in `allowed` of the text that the node holds.
std::size_t read_choice(const ConfigNode& node, const std::string& name,
                        const std::vector<std::string>& allowed);

// Writing: the node that reads back as the same value.
ConfigNode to_node(bool value);
ConfigNode to_node(int value);
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

// The visitors that the descriptions are shown to. `choice` takes the allowed names of a string, or
// pairs {name, value} of an enumeration.
using Names = std::initializer_list<const char*>;
template <class E>
using EnumNames = std::initializer_list<std::pair<const char*, std::type_identity_t<E>>>;

template <class E>
std::vector<std::string> names_of(EnumNames<E> pairs) {
  std::vector<std::string> names;
  for (const auto& pair : pairs) names.emplace_back(pair.first);
  return names;
}

template <class E>
std::string name_of(const E& value, EnumNames<E> pairs) {
  for (const auto& pair : pairs) {
    if (pair.second == value) return pair.first;
  }
  return "";
}

/// Lists what a struct describes.
class FieldDescriber {
 public:
  explicit FieldDescriber(std::string prefix = "") : prefix_(std::move(prefix)) {}

  template <class T>
  void operator()(const char* name, const T& value, const char* meaning);
  template <class T>
  void required(const char* name, const T& value, const char* meaning) {
    const std::size_t first = fields.size();
    (*this)(name, value, meaning);
    fields[first].value = "required";
  }
  void choice(const char* name, const std::string& value, Names names, const char* meaning) {
    add_choice(name, value, {names.begin(), names.end()}, meaning);
  }
  template <class E>
  requires std::is_enum_v<E>
  void choice(const char* name, const E& value, EnumNames<E> pairs, const char* meaning) {
    add_choice(name, name_of(value, pairs), names_of<E>(pairs), meaning);
  }

  std::vector<FieldHelp> fields;

 private:
  void add_choice(const char* name, const std::string& value,
                  const std::vector<std::string>& allowed, const char* meaning);

  std::string prefix_;
};

template <class T>
concept HasFields = requires(T& options, FieldDescriber& visit) {
  T::fields(options, visit);
};

template <HasFields T>
ConfigNode to_node(const T& value);
template <class T>
ConfigNode to_node(const std::vector<T>& value);
template <class T>
ConfigNode to_node(const std::optional<T>& value);
template <HasFields T>
ConfigNode to_node(const std::map<std::string, T>& value);

/// Collects the names of one struct, without those nested in it.
struct FieldNames {
  std::vector<std::string> names;

  void operator()(const char* name, const auto&, const char*) { names.emplace_back(name); }
  void required(const char* name, const auto&, const char*) { names.emplace_back(name); }
  void choice(const char* name, const std::string&, Names, const char*) {
    names.emplace_back(name);
  }
  template <class E>
  requires std::is_enum_v<E>
  void choice(const char* name, const E&, EnumNames<E>, const char*) { names.emplace_back(name); }
};

/// Reads the fields of a struct from a map.
class FieldReader {
 public:
  FieldReader(const ConfigNode& map, std::string prefix) : map_(map), prefix_(std::move(prefix)) {}

  template <class T>
  void operator()(const char* name, T& value, const char*) {
    if (const ConfigNode* node = map_.find(name)) read_value(*node, prefix_ + name, value);
  }
  template <class T>
  void required(const char* name, T& value, const char*) {
    read_value(get(name), prefix_ + name, value);
  }
  void choice(const char* name, std::string& value, Names names, const char*) {
    const ConfigNode* node = map_.find(name);
    if (!node) return;
    const std::vector<std::string> allowed(names.begin(), names.end());
    value = allowed[read_choice(*node, prefix_ + name, allowed)];
  }
  template <class E>
  requires std::is_enum_v<E>
  void choice(const char* name, E& value, EnumNames<E> pairs, const char*) {
    const ConfigNode* node = map_.find(name);
    if (!node) return;
    value = pairs.begin()[read_choice(*node, prefix_ + name, names_of<E>(pairs))].second;
  }

 private:
  const ConfigNode& get(const char* name) const;  ///< throws InputError where the key is missing

  const ConfigNode& map_;
  std::string prefix_;
};

/// Writes the fields of a struct into a map.
class FieldWriter {
 public:
  FieldWriter() { map.kind = ConfigNode::Kind::kMap; }

  template <class T>
  void operator()(const char* name, const T& value, const char*) {
    add(name, to_node(value));
  }
  template <class T>
  void required(const char* name, const T& value, const char*) {
    add(name, to_node(value));
  }
  void choice(const char* name, const std::string& value, Names, const char*) {
    add(name, to_node(value));
  }
  template <class E>
  requires std::is_enum_v<E>
  void choice(const char* name, const E& value, EnumNames<E> pairs, const char*) {
    add(name, to_node(name_of(value, pairs)));
  }

  ConfigNode map;

 private:
  void add(const char* name, ConfigNode node);
};

void check_map(const ConfigNode& node, const std::string& name);
void check_list(const ConfigNode& node, const std::string& name);

template <HasFields T>
void read_value(const ConfigNode& node, const std::string& name, T& value) {
  check_map(node, name);
  FieldNames known;
  T::fields(value, known);
  check_keys(node, known.names);  // first: a misspelt name is the usual cause of a missing one
  FieldReader reader(node, name.empty() ? "" : name + ".");
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
  for (const auto& [name, element] : value) writer(name.c_str(), element, "");
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
void FieldDescriber::operator()(const char* name, const T& value, const char* meaning) {
  using Element = typename ElementOf<T>::type;
  const std::string full = prefix_ + name;
  if constexpr (HasFields<Element>) {
    fields.push_back({full + ElementOf<T>::kSuffix, "", meaning});
    FieldDescriber nested(full + ElementOf<T>::kSuffix + ".");
    if constexpr (std::same_as<Element, T>) {
      T::fields(value, nested);
    } else {
      const Element defaults{};
      Element::fields(defaults, nested);
    }
    fields.insert(fields.end(), nested.fields.begin(), nested.fields.end());
  } else {
    fields.push_back({full, to_yaml_line(to_node(value)), meaning});
    if constexpr (std::same_as<T, std::map<std::string, TermSettings>>) {
      append_term_options(full, fields);
    }
  }
}

/// Reads `root` into the defaults of T. Throws InputError (naming the line, or the override) at an
/// unknown key, a missing one, or a value that is not of its field's type or out of its range.
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
