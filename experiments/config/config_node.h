#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace deformlab {

/// Deepest nesting of a config, so that no walk over one can exhaust the stack.
inline constexpr int kMaxConfigDepth = 64;

/// Where a value came from, as messages name it.
struct ConfigSource {
  std::string name;              ///< "c.yaml", or "override 'a.b=3'"
  std::filesystem::path folder;  ///< what a relative path in the value is relative to
  bool is_file = true;           ///< lines are told only for files
};

/// One value of a parsed YAML document: a plain tree, aliases already expanded. Also the type of an
/// option that is interpreted later (the values of a sweep, the list of edits).
struct ConfigNode {
  enum class Kind { kNull, kScalar, kList, kMap };

  Kind kind = Kind::kNull;
  std::string key;                   ///< its name where it stands in a map
  std::string text;                  ///< of a scalar, as written
  bool quoted = false;               ///< the scalar stood in quotes: it is text, never a number
  std::vector<ConfigNode> children;  ///< elements of a list, or values of a map, in file order
  std::shared_ptr<const ConfigSource> source;
  int key_line = 0;  ///< counted from 1; 0 where the value did not come from a file
  int line = 0;      ///< counted from 1; 0 where the value did not come from a file

  /// The value of a key, or null where the map has no such key or this is no map.
  const ConfigNode* find(std::string_view name) const;
  ConfigNode* find(std::string_view name);

  std::filesystem::path folder() const;  ///< what a relative path in it is relative to
  std::string where() const;             ///< "line 3 of c.yaml" or "override 'a.b=3'"
  std::string key_where() const;         ///< the same for its key
  std::string found() const;             ///< what a message shows: 'text', a list, a map, nothing
};

/// Parses one YAML value. Throws InputError (with the line) where the text is not YAML, repeats a
/// key, holds several documents, merge keys or tags beyond YAML's own, nests deeper than
/// kMaxConfigDepth or is too large once its aliases are expanded.
ConfigNode parse_yaml(const std::string& text, std::shared_ptr<const ConfigSource> source);

/// Reads a YAML file whose top level is a map. Throws InputError as parse_yaml, and where the file
/// cannot be read, is empty or holds something else than a map.
ConfigNode load_config(const std::filesystem::path& path);

/// The node as YAML, ending in a newline, which reads back as the same values.
std::string to_yaml(const ConfigNode& node);

/// The node as YAML on one line, such as `{axis: [0, 0, 1], degrees: 30}`.
std::string to_yaml_line(const ConfigNode& node);

}  // namespace deformlab
