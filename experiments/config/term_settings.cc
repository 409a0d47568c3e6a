#include "experiments/config/config.h"

// The weights and options of energy terms in configs.
namespace deformlab {
namespace {

void read_map(const ConfigNode& node, const std::string& name, const EnergyInfo& info,
              TermSettings& settings) {
  std::vector<std::string> known{"weight"};
  for (const OptionInfo& option : info.options) known.push_back(option.name);
  check_keys(node, known);
  if (const ConfigNode* weight = node.find("weight")) {
    read_value(*weight, name + ".weight", settings.weight);
  }
  for (const OptionInfo& option : info.options) {
    const ConfigNode* given = node.find(option.name);
    if (!given) continue;
    const std::string full = name + "." + option.name;
    OptionValue value = option.value;
    if (option.allowed.empty()) {
      std::visit([&](auto& v) { read_value(*given, full, v); }, value);
    } else {
      value = option.allowed[read_name(*given, full, option.allowed)];
    }
    settings.options[option.name] = value;
  }
}

ConfigNode option_node(const OptionValue& value) {
  return std::visit([](const auto& v) { return to_node(v); }, value);
}

ConfigNode settings_node(const TermSettings& settings) {
  if (settings.options.empty()) return to_node(settings.weight);
  FieldWriter writer;
  if (settings.weight) writer.add("weight", to_node(*settings.weight));
  for (const auto& [name, value] : settings.options) writer.add(name, option_node(value));
  return std::move(writer.map);
}

}  // namespace

void read_value(const ConfigNode& node, const std::string& name,
                std::map<std::string, TermSettings>& value) {
  check_map(node, name);
  std::vector<std::string> known;
  for (const EnergyInfo& info : known_energies()) known.push_back(info.name);
  check_keys(node, known, "energy");
  for (const ConfigNode& child : node.children) {
    TermSettings& settings = value[child.key];
    const std::string full = name + "." + child.key;
    if (child.kind == ConfigNode::Kind::kMap) {
      read_map(child, full, energy_info(child.key), settings);
    } else {
      read_value(child, full, settings.weight.emplace());
    }
  }
}

ConfigNode to_node(const std::map<std::string, TermSettings>& value) {
  FieldWriter writer;
  for (const auto& [name, settings] : value) writer.add(name, settings_node(settings));
  return std::move(writer.map);
}

void append_term_options(const std::string& name, std::vector<FieldHelp>& fields) {
  for (const EnergyInfo& info : known_energies()) {
    for (const OptionInfo& option : info.options) {
      fields.push_back({name + "." + info.name + "." + option.name,
                        to_yaml_line(option_node(option.value)), option.meaning});
    }
  }
}

}  // namespace deformlab
