#include "experiments/run.h"

#include <glog/logging.h>

#include <optional>

#include "energies/catalog.h"
#include "experiments/config.h"
#include "experiments/edit.h"
#include "experiments/pictures.h"

namespace deformlab {
namespace {

ConfigNode with_overrides(ConfigNode root, const std::vector<Override>& overrides) {
  for (const Override& change : overrides) apply_override(root, change);
  return root;
}

ExperimentConfig read(const ConfigNode& root) {
  auto config = read_config<ExperimentConfig>(root);
  complete_energies(root, config.deformation);
  return config;
}

Run run_once(const ExperimentConfig& config, const std::filesystem::path& folder,
             const std::string& caption, bool first, PictureBook& pictures) {
  const Shape rest = make_shape(config.shape, folder);
  const ResolvedEdit edit = resolve(read_edit(config.edit), rest);
  EmbeddedDeformation deformer(rest, config.deformation);
  deformer.compile(edit.handles);
  const Report report = deformer.update(edit.targets);
  Run run;
  run.solve = report.solve;
  run.notes = report.notes;
  run.seconds = seconds_of(report);
  run.measured.metrics = metrics_of(report);
  const double size = bounding_box_diagonal(rest.V);
  run.measured.metrics["vertices"] = static_cast<double>(rest.V.cols());
  run.measured.metrics["handles"] = static_cast<double>(edit.handles.moved.size());
  run.measured.metrics["handle_rms_relative"] = size > 0 ? report.handle_rms / size : 0;
  run.measured.metrics.merge(distortion(rest, deformer.deformed()));
  run.measured.metrics.merge(node_shear(deformer.transformations()));
  if (first) pictures.add_rest(deformer, rest, edit);
  pictures.add_deformed(deformer, edit, caption);
  for (const std::string& note : run.notes) LOG(WARNING) << note;
  return run;
}

// Claims may speak of times too.
std::vector<MeasuredRun> with_seconds(const std::vector<Run>& runs) {
  std::vector<MeasuredRun> result;
  for (const Run& run : runs) {
    result.push_back(run.measured);
    result.back().metrics.insert(run.seconds.begin(), run.seconds.end());
  }
  return result;
}

}  // namespace

void complete_energies(const ConfigNode& root, EmbeddedDeformationOptions& options) {
  std::vector<std::string> names;
  for (const EnergyInfo& info : known_energies()) {
    names.push_back(info.name);
    options.energies.try_emplace(info.name, info.default_weight);
  }
  if (const ConfigNode* energies = root.find("energies")) check_keys(*energies, names, "energy");
}

std::string label(const MeasuredRun& run) {
  std::string text;
  for (const auto& [key, value] : run.settings) {
    const std::string name = key.substr(key.rfind('.') + 1);
    text += (text.empty() ? "" : ", ") + name + " " + value;
  }
  return text;
}

Outcome run_experiment(const std::filesystem::path& path, const std::vector<Override>& overrides,
                       const Progress& progress) {
  const ConfigNode root = with_overrides(load_config(path), overrides);
  Outcome outcome;
  outcome.config = read(root);
  outcome.resolved = to_node(outcome.config);
  const auto combinations = expand_sweep(outcome.config.sweep);
  std::vector<ExperimentConfig> configs;  // all are read before the first is run
  for (const auto& combination : combinations) {
    configs.push_back(read(with_overrides(root, combination)));
    make_solver(configs.back().deformation.solver);
    read_edit(configs.back().edit);
  }
  PictureBook pictures(outcome.config.picture);
  for (std::size_t i = 0; i < configs.size(); ++i) {
    MeasuredRun settings;
    for (const Override& o : combinations[i]) settings.settings.emplace_back(o.key, o.value);
    progress(i + 1, configs.size(), label(settings));
    const std::string caption = configs.size() > 1 ? label(settings) : "deformed";
    outcome.runs.push_back(run_once(configs[i], path.parent_path(), caption, i == 0, pictures));
    outcome.runs.back().measured.settings = settings.settings;
  }
  const std::vector<MeasuredRun> measured = with_seconds(outcome.runs);
  for (const Claim& claim : outcome.config.claims) outcome.claims.push_back(check(claim, measured));
  outcome.picture = pictures.render();
  return outcome;
}

}  // namespace deformlab
