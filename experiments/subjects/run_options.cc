#include "experiments/subjects/run_options.h"

#include <string>
#include <vector>

#include "energies/catalog.h"
#include "experiments/config/config.h"

namespace deformlab {

void begin_with_preset(const ConfigNode& root, MethodOptions& options) {
  const ConfigNode* preset = root.find("preset");
  if (preset == nullptr) return;
  read_value(*preset, "preset", options.preset);
  options.deformation = preset_options(options.preset);
}

void complete_energies(const ConfigNode& root, EmbeddedDeformationOptions& options) {
  std::vector<std::string> names;
  for (const EnergyInfo& info : known_energies()) {
    names.push_back(info.name);
    std::optional<double>& weight = options.energies[info.name].weight;
    if (!weight) weight = info.default_weight;
  }
  for (const char* map : {"energies", "losses"}) {
    if (const ConfigNode* by_name = root.find(map)) check_keys(*by_name, names, "energy");
  }
}

RunOptions read_run_options(const ConfigNode& root) {
  RunOptions options;
  begin_with_preset(root, options.method);
  read_value(root, "", options);
  complete_energies(root, options.method.deformation);
  return options;
}

void check_run_options(const RunOptions& options, const ConfigNode& root) {
  with_lines_of(root, [&] {
    inside_option("solver", [&] { make_solver(options.method.deformation.solver); });
  });
  check(options.measure);
  check(options.picture);
}

}  // namespace deformlab
