#include "experiments/config/override.h"

#include <fmt/format.h>

#include <charconv>
#include <utility>

#include "experiments/config/suggest.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

std::vector<std::string> split_key(const std::string& key, const std::string& whose) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    if (end == begin) {
      throw InputError(fmt::format(
          "{} has an empty name in its key; write names joined by single dots, such as graph.nodes",
          whose));
    }
    names.push_back(key.substr(begin, end - begin));
    begin = end + 1;
  }
  if (names.size() > static_cast<std::size_t>(kMaxConfigDepth)) {
    throw InputError(fmt::format("{} has more than {} names", whose, kMaxConfigDepth));
  }
  return names;
}

ConfigNode& element(ConfigNode& list, const std::string& name, const std::string& whose) {
  std::size_t index = 0;
  const char* end = name.data() + name.size();
  const auto [last, error] = std::from_chars(name.data(), end, index);
  if (error != std::errc() || last != end || index >= list.children.size()) {
    throw InputError(
        fmt::format("{}: no element {} in the list ({}), which has {} elements, counted from 0",
                    whose, quote(name), list.where(), list.children.size()));
  }
  return list.children[index];
}

ConfigNode& step(ConfigNode& node, const std::string& name,
                 const std::shared_ptr<const ConfigSource>& source) {
  if (node.kind == ConfigNode::Kind::kList) return element(node, name, source->name);
  if (node.kind == ConfigNode::Kind::kScalar) {
    throw InputError(fmt::format("{} looks for {} inside {} ({}), which is not a map", source->name,
                                 quote(name), node.found(), node.where()));
  }
  node.kind = ConfigNode::Kind::kMap;
  if (ConfigNode* child = node.find(name)) return *child;
  ConfigNode& child = node.children.emplace_back();
  child.key = name;
  child.source = source;
  return child;
}

// Checks that the values are a list, or maps by their names.
void check_values(const ConfigNode& values, const std::string& whose) {
  const bool named = values.kind == ConfigNode::Kind::kMap;
  if ((!named && values.kind != ConfigNode::Kind::kList) || values.children.empty()) {
    throw InputError(fmt::format(
        "{} needs a list of one value or more, or maps of keys by their names, found {}", whose,
        values.found()));
  }
  for (const ConfigNode& row : values.children) {
    if (!named || (row.kind == ConfigNode::Kind::kMap && !row.children.empty())) continue;
    throw InputError(fmt::format("{}: {} ({}) must map keys of the config to values, found {}",
                                 whose, quote(row.key), row.key_where(), row.found()));
  }
}

void check_sweep(const ConfigNode& sweep) {
  if (sweep.kind != ConfigNode::Kind::kMap) {
    throw InputError(fmt::format("'sweep' must map dotted keys to lists ({}), found {}",
                                 sweep.where(), sweep.found()));
  }
  std::size_t runs = 1;
  for (const ConfigNode& values : sweep.children) {
    const std::string whose = "sweep over " + quote(values.key) + " (" + values.key_where() + ")";
    split_key(values.key, whose);
    check_values(values, whose);
    runs *= values.children.size();
    if (runs > kMaxSweepRuns) {
      throw InputError(
          fmt::format("{} makes more than {} runs; shorten the lists", whose, kMaxSweepRuns));
    }
  }
}

}  // namespace

Override parse_override(std::string_view text) {
  const std::string whose = "override " + quote(text);
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw InputError(
        fmt::format("{} must have the form key=value, such as graph.nodes=300", whose));
  }
  Override change{std::string(text.substr(0, equals)), std::string(text.substr(equals + 1)), {}};
  split_key(change.key, whose);
  return change;
}

void apply_override(ConfigNode& root, const Override& change) {
  const auto source = std::make_shared<const ConfigSource>(
      ConfigSource{"override " + quote(change.text()), change.folder, false});
  const std::vector<std::string> names = split_key(change.key, source->name);
  ConfigNode value = parse_yaml(change.value, source);
  ConfigNode* node = &root;
  for (const std::string& name : names) node = &step(*node, name, source);
  value.key = std::move(node->key);
  *node = std::move(value);
}

namespace {

// A map among a sweep's values sets its keys, and does not change others.
void append_settings(const std::string& key, const ConfigNode& value, std::vector<Override>& run) {
  if (value.kind != ConfigNode::Kind::kMap) {
    run.push_back({key, to_yaml_line(value), value.folder()});
    return;
  }
  for (const ConfigNode& child : value.children) {
    append_settings(key + "." + child.key, child, run);
  }
}

void append_value(const ConfigNode& values, const ConfigNode& value, SweptRun& run) {
  const std::size_t before = run.overrides.size();
  if (values.kind == ConfigNode::Kind::kMap) {
    run.settings.emplace_back(values.key, value.key);
    for (const ConfigNode& child : value.children) append_settings(child.key, child, run.overrides);
    return;
  }
  append_settings(values.key, value, run.overrides);
  for (std::size_t i = before; i < run.overrides.size(); ++i) {
    run.settings.emplace_back(run.overrides[i].key, run.overrides[i].value);
  }
}

}  // namespace

std::vector<const ConfigNode*> swept_keys(const ConfigNode& sweep) {
  std::vector<const ConfigNode*> keys;
  for (const ConfigNode& values : sweep.children) {
    if (values.kind != ConfigNode::Kind::kMap) keys.push_back(&values);
    for (const ConfigNode& row : values.children) {
      if (values.kind != ConfigNode::Kind::kMap) break;
      for (const ConfigNode& key : row.children) keys.push_back(&key);
    }
  }
  return keys;
}

std::vector<SweptRun> expand_sweep(const ConfigNode& sweep) {
  std::vector<SweptRun> runs(1);
  if (sweep.kind == ConfigNode::Kind::kNull) return runs;
  check_sweep(sweep);
  for (const ConfigNode& values : sweep.children) {
    std::vector<SweptRun> longer;
    for (const SweptRun& run : runs) {
      for (const ConfigNode& value : values.children) {
        longer.push_back(run);
        append_value(values, value, longer.back());
      }
    }
    runs = std::move(longer);
  }
  return runs;
}

}  // namespace deformlab
