#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace deformlab {

/// The deepest nesting of a config. It keeps recursive functions from exhausting the stack.
inline constexpr int kMaxConfigDepth = 64;

/// Where a value came from, as messages name it.
struct ConfigSource {
  std::string name;              ///< "c.yaml", or "override 'a.b=3'"
  std::filesystem::path folder;  ///< where relative paths in the value begin
  bool is_file = true;           ///< whether messages give lines
};

/// One value of a parsed YAML document, as a tree in which aliases are expanded. It is also the
/// type of an option that is interpreted later (the values of a sweep, the list of edits).
struct ConfigNode {
  enum class Kind { kNull, kScalar, kList, kMap };

  Kind kind = Kind::kNull;
  std::string key;                   ///< its name, if it is in a map
  std::string text;                  ///< the text of a scalar, as written
  bool quoted = false;               ///< whether a scalar is in quotes, so that it is no number
  std::vector<ConfigNode> children;  ///< elements of a list, or values of a map, in file order
  std::shared_ptr<const ConfigSource> source;
  int key_line = 0;  ///< counted from 1; 0 if the value did not come from a file
  int line = 0;      ///< counted from 1; 0 if the value did not come from a file

  /// The value of a key, or null if there is no such key or this is no map.
  const ConfigNode* find(std::string_view name) const;
  ConfigNode* find(std::string_view name);

  std::filesystem::path folder() const;  ///< where relative paths in it begin
  std::string where() const;             ///< "line 3 of c.yaml" or "override 'a.b=3'"
  std::string key_where() const;         ///< the same for its key
  std::string found() const;             ///< what a message shows: 'text', a list, a map, nothing
};

/// Parses one YAML value. Throws InputError (with the line) if the text is not YAML, repeats a key,
/// has several documents, merge keys or tags that are not YAML's own, nests deeper than
/// kMaxConfigDepth, or is too large when its aliases are expanded.
ConfigNode parse_yaml(const std::string& text, std::shared_ptr<const ConfigSource> source);

/// Reads a YAML file whose top level is a map. Throws InputError as parse_yaml does, and if the
/// file cannot be read, is empty, or does not contain a map.
ConfigNode load_config(const std::filesystem::path& path);

/// The node as YAML that ends in a newline. Parsing it gives the same values.
std::string to_yaml(const ConfigNode& node);

/// The node as YAML on one line, such as `{axis: [0, 0, 1], degrees: 30}`.
std::string to_yaml_line(const ConfigNode& node);

}  // namespace deformlab
