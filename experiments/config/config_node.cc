#include "experiments/config/config_node.h"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <utility>

#include "experiments/config/suggest.h"
#include "experiments/config/yaml_check.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

std::string place(const std::shared_ptr<const ConfigSource>& source, int line) {
  if (!source) return "default";
  return line > 0 && source->is_file ? "line " + std::to_string(line) + " of " + source->name
                                     : source->name;
}

[[noreturn]] void throw_too_deep(const std::string& where) {
  throw InputError(fmt::format(
      "nested deeper than {} levels ({}); is a bracket left open, or does an alias contain itself?",
      kMaxConfigDepth, where));
}

/// Copies yaml-cpp's tree into ours, and throws for what a config may not contain.
class Converter {
 public:
  explicit Converter(std::shared_ptr<const ConfigSource> source) : source_(std::move(source)) {}

  ConfigNode convert(const YAML::Node& yaml, int depth, int parent_line) {
    ConfigNode node;
    node.source = source_;
    node.line = yaml.Mark().is_null() ? parent_line : yaml.Mark().line + 1;
    check_limits(node, depth);
    check_tag(yaml.Tag(), node);
    if (yaml.IsScalar()) {
      node.kind = ConfigNode::Kind::kScalar;
      node.text = yaml.Scalar();
      node.quoted = yaml.Tag() == "!" || yaml.Tag() == "tag:yaml.org,2002:str";
    } else if (yaml.IsSequence()) {
      node.kind = ConfigNode::Kind::kList;
      for (const auto& child : yaml) {
        node.children.push_back(convert(child, depth + 1, node.line));
      }
    } else if (yaml.IsMap()) {
      node.kind = ConfigNode::Kind::kMap;
      add_entries(yaml, depth, node);
    }
    return node;
  }

 private:
  void check_limits(const ConfigNode& node, int depth) {
    if (depth > kMaxConfigDepth) throw_too_deep(node.where());
    if (++count_ > kMaxConfigValues) {  // only an alias in itself passes check_yaml
      throw InputError(
          fmt::format("more than {} values ({}) with all aliases expanded; make the file smaller",
                      kMaxConfigValues, node.where()));
    }
  }

  static void check_tag(const std::string& tag, const ConfigNode& node) {
    const bool plain = tag.empty() || tag == "?" || tag == "!";
    if (plain || tag.starts_with("tag:yaml.org,2002:")) return;
    throw InputError(fmt::format("unknown tag {} ({}); leave it out", quote(tag), node.where()));
  }

  [[noreturn]] void throw_duplicate(const std::string& key, int first, int second) const {
    const std::string also = source_->is_file ? "line " + std::to_string(first) + " and " : "";
    throw InputError(fmt::format("duplicate key {} ({}{}); keep one of them", quote(key), also,
                                 place(source_, second)));
  }

  void add_entries(const YAML::Node& yaml, int depth, ConfigNode& map) {
    std::map<std::string, int> lines;
    for (const auto& entry : yaml) {
      const int line = std::max(entry.first.Mark().line + 1, 1);
      if (!entry.first.IsScalar()) {
        throw InputError(fmt::format("a key must be a name ({})", place(source_, line)));
      }
      const std::string& key = entry.first.Scalar();
      const auto [first, is_new] = lines.emplace(key, line);
      if (!is_new) throw_duplicate(key, first->second, line);
      if (key == "<<") {
        throw InputError(fmt::format(
            "merge key '<<' ({}) is not supported; write its keys out, or use an alias as a value",
            place(source_, line)));
      }
      map.children.push_back(convert(entry.second, depth + 1, line));
      map.children.back().key = key;
      map.children.back().key_line = line;
    }
  }

  std::shared_ptr<const ConfigSource> source_;
  std::size_t count_ = 0;
};

/// Unlike read_file, this also reads a pipe, so that a shell can generate the config of a run.
std::string read_text(const std::filesystem::path& path) {
  check_readable(path, true);
  std::ifstream file(path, std::ios::binary);
  if (!file) cannot_read(path, "permission denied");
  std::string text;
  std::array<char, 1 << 16> part;
  while (file && text.size() <= kMaxConfigBytes) {
    file.read(part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) cannot_read(path, "reading failed");
  if (text.size() > kMaxConfigBytes) cannot_read(path, "larger than 32 MiB");
  return text;
}

/// Quotes the text if necessary. The emitter does not quote tabs, carriage returns and the marks of
/// documents, which would then not be read again.
void emit_text(YAML::Emitter& out, const std::string& text, bool quoted) {
  const bool is_mark = text.starts_with("---") || text.starts_with("...");
  if (quoted || is_mark || text.find_first_of("\t\r") != std::string::npos) {
    out << YAML::DoubleQuoted;
  }
  out << text;
}

void emit(YAML::Emitter& out, const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::kNull:
      out << YAML::Null;
      return;
    case ConfigNode::Kind::kScalar:
      emit_text(out, node.text, node.quoted);
      return;
    case ConfigNode::Kind::kList: {
      const bool short_list = std::all_of(
          node.children.begin(), node.children.end(),
          [](const ConfigNode& child) { return child.kind <= ConfigNode::Kind::kScalar; });
      if (short_list) out << YAML::Flow;
      out << YAML::BeginSeq;
      for (const ConfigNode& child : node.children) emit(out, child);
      out << YAML::EndSeq;
      return;
    }
    case ConfigNode::Kind::kMap:
      out << YAML::BeginMap;
      for (const ConfigNode& child : node.children) {
        out << YAML::Key;
        emit_text(out, child.key, false);
        out << YAML::Value;
        emit(out, child);
      }
      out << YAML::EndMap;
  }
}

}  // namespace

const ConfigNode* ConfigNode::find(std::string_view name) const {
  if (kind != Kind::kMap) return nullptr;
  for (const ConfigNode& child : children) {
    if (child.key == name) return &child;
  }
  return nullptr;
}

ConfigNode* ConfigNode::find(std::string_view name) {
  return const_cast<ConfigNode*>(std::as_const(*this).find(name));
}

std::filesystem::path ConfigNode::folder() const {
  return source ? source->folder : std::filesystem::path();
}

std::string ConfigNode::where() const { return place(source, line); }

std::string ConfigNode::key_where() const { return place(source, key_line); }

std::string ConfigNode::found() const {
  switch (kind) {
    case Kind::kNull:
      return "nothing";
    case Kind::kScalar:
      return (quoted ? "the quoted text " : "") + quote(text);
    case Kind::kList:
      return "a list of " + std::to_string(children.size());
    case Kind::kMap:
      return "a map";
  }
  return "nothing";
}

ConfigNode parse_yaml(const std::string& text, std::shared_ptr<const ConfigSource> source) {
  YAML::Node document;
  try {
    check_yaml(text, source);
    document = YAML::Load(text);
  } catch (const YAML::DeepRecursion& error) {
    throw_too_deep(place(source, error.mark.line + 1));
  } catch (const YAML::Exception& error) {
    throw InputError(
        fmt::format("not valid YAML ({}): {}", place(source, error.mark.line + 1), error.msg));
  }
  return Converter(std::move(source)).convert(document, 0, 1);
}

ConfigNode load_config(const std::filesystem::path& path) {
  ConfigSource source{path.string(), path.parent_path()};
  ConfigNode root =
      parse_yaml(read_text(path), std::make_shared<const ConfigSource>(std::move(source)));
  if (root.kind == ConfigNode::Kind::kNull)
    throw InputError(fmt::format("{} is empty", quote(path.string())));
  if (root.kind != ConfigNode::Kind::kMap) {
    throw InputError(fmt::format("the top level must be a map of keys ({}), found {}", root.where(),
                                 root.found()));
  }
  return root;
}

std::string to_yaml(const ConfigNode& node) {
  YAML::Emitter out;
  emit(out, node);
  return std::string(out.c_str()) + "\n";
}

std::string to_yaml_line(const ConfigNode& node) {
  YAML::Emitter out;
  out.SetSeqFormat(YAML::Flow);
  out.SetMapFormat(YAML::Flow);
  emit(out, node);
  return out.c_str();
}

}  // namespace deformlab
