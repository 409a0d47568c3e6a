#include "experiments/config/config.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "experiments/config/suggest.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

/// Whether the whole text is one number in the range of T.
template <class T>
bool parse_number(std::string_view text, T& value) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return false;
  }
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && last == end;
}

template <class T>
void read_number(const ConfigNode& node, const std::string& name, T& value,
                 const std::string& expected) {
  T number{};
  const bool plain = node.kind == ConfigNode::Kind::kScalar && !node.quoted;
  if (!plain || !parse_number(node.text, number)) throw_wrong_value(node, name, expected);
  value = number;
}

template <class T>
std::string whole_number() {
  return fmt::format("a whole number from {} to {}", std::numeric_limits<T>::min(),
                     std::numeric_limits<T>::max());
}

ConfigNode scalar(std::string text, bool quoted = false) {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kScalar;
  node.text = std::move(text);
  node.quoted = quoted;
  return node;
}

}  // namespace

void check_keys(const ConfigNode& map, const std::vector<std::string>& known,
                const std::string& what, const std::string& prefix) {
  for (const ConfigNode& child : map.children) {
    if (std::find(known.begin(), known.end(), child.key) != known.end()) continue;
    throw InputError(fmt::format("unknown {} {} ({}); {}", what, quote(child.key),
                                 child.key_where(), known_names(child.key, known, prefix)));
  }
}

void throw_wrong_value(const ConfigNode& node, const std::string& name,
                       const std::string& expected) {
  throw InputError(fmt::format("wrong value for {} ({}): expected {}, found {}", quote(name),
                               node.where(), expected, node.found()));
}

std::string to_text(const std::vector<FieldHelp>& fields) {
  std::size_t name_width = 0;
  std::size_t value_width = 0;
  for (const FieldHelp& field : fields) {
    name_width = std::max(name_width, field.name.size());
    value_width = std::max(value_width, field.value.size());
  }
  std::string text;
  for (const FieldHelp& field : fields) {
    text += "  " + field.name + std::string(name_width - field.name.size() + 2, ' ');
    text += field.value + std::string(value_width - field.value.size() + 2, ' ');
    text += field.meaning + "\n";
  }
  return text;
}

void read_value(const ConfigNode& node, const std::string& name, bool& value) {
  const bool plain = node.kind == ConfigNode::Kind::kScalar && !node.quoted;
  if (!plain || (node.text != "true" && node.text != "false")) {
    throw_wrong_value(node, name, "true or false");
  }
  value = node.text == "true";
}

void read_value(const ConfigNode& node, const std::string& name, int& value) {
  read_number(node, name, value, whole_number<int>());
}

void read_value(const ConfigNode& node, const std::string& name, std::int64_t& value) {
  read_number(node, name, value, whole_number<std::int64_t>());
}

void read_value(const ConfigNode& node, const std::string& name, std::uint64_t& value) {
  read_number(node, name, value, whole_number<std::uint64_t>());
}

void read_value(const ConfigNode& node, const std::string& name, double& value) {
  double number = 0;
  read_number(node, name, number, "a finite number");
  if (!std::isfinite(number)) throw_wrong_value(node, name, "a finite number");
  value = number;
}

void read_value(const ConfigNode& node, const std::string& name, std::string& value) {
  if (node.kind != ConfigNode::Kind::kScalar) throw_wrong_value(node, name, "text");
  value = node.text;
}

void read_value(const ConfigNode& node, const std::string& name, std::filesystem::path& value) {
  if (node.kind != ConfigNode::Kind::kScalar) throw_wrong_value(node, name, "a path");
  value = node.text;
}

void read_value(const ConfigNode& node, const std::string& name, Eigen::Vector3d& value) {
  if (node.kind != ConfigNode::Kind::kList || node.children.size() != 3) {
    throw_wrong_value(node, name, "a list of 3 numbers");
  }
  for (int i = 0; i < 3; ++i) {
    read_value(node.children[i], name + "[" + std::to_string(i) + "]", value[i]);
  }
}

void read_value(const ConfigNode& node, const std::string& name,
                std::map<std::string, double>& value) {
  check_map(node, name);
  for (const ConfigNode& child : node.children) {
    read_value(child, name + "." + child.key, value[child.key]);
  }
}

void read_value(const ConfigNode& node, const std::string&, ConfigNode& value) { value = node; }

std::size_t read_name(const ConfigNode& node, const std::string& name,
                      const std::vector<std::string>& names) {
  std::string text;
  read_value(node, name, text);
  const auto match = std::find(names.begin(), names.end(), text);
  if (match != names.end()) return static_cast<std::size_t>(match - names.begin());
  throw InputError(fmt::format("unknown value {} for {} ({}); {}", quote(text), quote(name),
                               node.where(), known_names(text, names)));
}

namespace {

// The value of a dotted path such as "parts[1].nodes", or null if the config does not have it.
const ConfigNode* find_path(const ConfigNode& map, std::string_view path) {
  const ConfigNode* node = &map;
  while (node != nullptr && !path.empty()) {
    const bool is_index = path.front() == '[';
    const std::size_t end = std::min(path.find_first_of(is_index ? "]" : ".[", 0), path.size());
    if (is_index) {
      std::size_t index = 0;
      const bool known = parse_number(path.substr(1, end - 1), index);
      node = known && index < node->children.size() ? &node->children[index] : nullptr;
    } else {
      node = node->find(path.substr(0, end));
    }
    path.remove_prefix(std::min(end + (is_index ? 1 : 0), path.size()));
    if (path.starts_with('.')) path.remove_prefix(1);
  }
  return node;
}

}  // namespace

InputError located(const OptionError& error, const ConfigNode& map, const std::string& prefix) {
  const ConfigNode* node = find_path(map, error.field());
  return InputError(fmt::format("{}{} is {} ({}){}", prefix, error.field(), error.value(),
                                node == nullptr ? "the default" : node->where(),
                                error.explanation()));
}

ConfigNode to_node(bool value) { return scalar(value ? "true" : "false"); }

ConfigNode to_node(int value) { return scalar(std::to_string(value)); }

ConfigNode to_node(std::int64_t value) { return scalar(std::to_string(value)); }

ConfigNode to_node(std::uint64_t value) { return scalar(std::to_string(value)); }

ConfigNode to_node(double value) {
  char text[32];  // the shortest text that reads back as the same number needs 24 at most
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return scalar(std::string(text, end));
}

ConfigNode to_node(const std::string& value) {
  double number = 0;  // quotes text that looks like a number or a truth value
  const bool ambiguous = parse_number(value, number) || value == "true" || value == "false";
  return scalar(value, ambiguous);
}

ConfigNode to_node(const std::filesystem::path& value) { return to_node(value.string()); }

ConfigNode to_node(const Eigen::Vector3d& value) {
  return to_node(std::vector<double>{value.x(), value.y(), value.z()});
}

ConfigNode to_node(const std::map<std::string, double>& value) {
  FieldWriter writer;
  for (const auto& [name, number] : value) writer.add(name, to_node(number));
  return std::move(writer.map);
}

ConfigNode to_node(const ConfigNode& value) { return value; }

void check_map(const ConfigNode& node, const std::string& name) {
  if (node.kind != ConfigNode::Kind::kMap) throw_wrong_value(node, name, "a map of keys");
}

void check_list(const ConfigNode& node, const std::string& name) {
  if (node.kind != ConfigNode::Kind::kList) throw_wrong_value(node, name, "a list");
}

void FieldDescriber::add(const std::string& name, const std::string& value, const Field& field,
                         const std::vector<std::string>& names) {
  std::string meaning = field.meaning;
  const std::string allowed =
      names.empty() ? field.range.text() : fmt::format("{}", fmt::join(names, " | "));
  if (!allowed.empty()) meaning += (names.empty() ? "; allowed: " : ": ") + allowed;
  fields.push_back({name, field.required ? "required" : value, meaning});
}

const ConfigNode& FieldReader::get(const char* name) const {
  if (const ConfigNode* node = map_.find(name)) return *node;
  const std::string inside =
      prefix_.empty() ? "" : " in " + quote(prefix_.substr(0, prefix_.size() - 1));
  throw InputError(fmt::format("missing key {}{} ({})", quote(name), inside, map_.where()));
}

void FieldWriter::add(const std::string& name, ConfigNode node) {
  node.key = name;
  map.children.push_back(std::move(node));
}

}  // namespace deformlab
