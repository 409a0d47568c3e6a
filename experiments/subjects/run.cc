#include "experiments/subjects/run.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "energies/catalog.h"
#include "experiments/config/config.h"
#include "experiments/config/suggest.h"
#include "experiments/measure/reference.h"
#include "experiments/subjects/animation/animation_run.h"
#include "experiments/subjects/drawing/drawing_run.h"
#include "experiments/subjects/shape/cuts.h"
#include "experiments/subjects/shape/shape_run.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr std::size_t kLongestLabel = 40;  // of a swept value in a caption

ConfigNode with_overrides(ConfigNode root, const std::vector<Override>& overrides) {
  for (const Override& change : overrides) apply_override(root, change);
  return root;
}

// A sweep would silently win over what was asked for on the command line.
void check_not_swept(const std::vector<Override>& overrides, const ConfigNode& sweep) {
  for (const Override& change : overrides) {
    for (const ConfigNode* swept : swept_keys(sweep)) {
      const bool same = change.key == swept->key || change.key.starts_with(swept->key + ".") ||
                        swept->key.starts_with(change.key + ".");
      if (!same) continue;
      throw InputError("override " + quote(change.text()) + ": the config sweeps over '" +
                       swept->key + "' itself (" + swept->key_where() +
                       "); override 'sweep={...}' instead, or 'sweep=null' for a single run");
    }
  }
}

ExperimentConfig read(const ConfigNode& root) {
  auto config = read_config<ExperimentConfig>(root);
  complete_energies(root, config.method.deformation);
  return config;
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

// Each run is of the rest of the config: the claims, the sweep and the picture, but for where it is
// seen from, are of all of them.
void check_swept_keys(const ConfigNode& sweep) {
  for (const ConfigNode* swept : swept_keys(sweep)) {
    if (swept->key == "picture.direction" || swept->key == "picture.up") continue;
    const std::string key = swept->key.substr(0, swept->key.find('.'));
    for (const char* whole : {"title", "paper", "picture", "sweep", "claims"}) {
      if (key != whole) continue;
      throw InputError("the sweep over " + quote(swept->key) + " (" + swept->key_where() +
                       ") changes no run: '" + key + "' is one for all of them");
    }
  }
}

bool is_drawing(const ExperimentConfig& config) { return !config.drawing.file.empty(); }

bool is_animation(const ExperimentConfig& config) {
  return config.animation.generator != AnimationGenerator::kNone;
}

void check_edit(const ExperimentConfig& config) {
  if (is_animation(config)) {
    check(config.animation, config.edit);
  } else if (is_drawing(config)) {
    read_plane_edit(config.edit);
    check_paint(config.paint);
    read_probes(config.measure.probes, 2);
  } else {
    read_edit(config.edit);
    check_cuts(config.cut);
    read_probes(config.measure.probes, 3);
  }
}

// A config that was read whole: nothing in it is unknown, of a wrong type or out of its range.
struct Plan {
  ExperimentConfig config;
  std::vector<SweptRun> combinations;
  std::vector<ExperimentConfig> runs;
  std::vector<ConfigNode> roots;         ///< what each run was read from
  std::optional<std::size_t> reference;  ///< the run that all are compared with
};

Plan plan(const std::filesystem::path& path, const std::vector<Override>& overrides) {
  const ConfigNode root = with_overrides(load_config(path), overrides);
  Plan result{read(root), {}, {}, {}, {}};
  check(result.config.picture);
  for (const Claim& claim : result.config.claims) check_form(claim);
  check_not_swept(overrides, result.config.sweep);
  check_swept_keys(result.config.sweep);
  result.combinations = expand_sweep(result.config.sweep);
  for (const auto& combination : result.combinations) {
    const ConfigNode& its = result.roots.emplace_back(with_overrides(root, combination.overrides));
    result.runs.push_back(read(its));
    const SolverOptions& solver = result.runs.back().method.deformation.solver;
    with_lines_of(its, [&] { inside_option("solver", [&] { make_solver(solver); }); });
    check(result.runs.back().measure);
    check(result.runs.back().picture);
    check_edit(result.runs.back());
  }
  if (result.config.measure.reference.kind != ConfigNode::Kind::kNull) {
    result.reference = find_reference(result.config.measure.reference, result.combinations);
  }
  return result;
}

// The pictures of all runs, by what they are of.
class Books {
 public:
  explicit Books(const PictureOptions& options)
      : drawings_(options), shapes_(options), animations_(options) {}

  Run run(const ExperimentConfig& config, const std::filesystem::path& folder,
          const std::string& caption) {
    if (is_drawing(config)) {
      return run_drawing(config, folder, caption, drawings_.empty(), drawings_);
    }
    const Camera camera = render_options(config.picture).camera;
    shapes_.look_by(camera);
    animations_.look_by(camera);
    if (is_animation(config)) {
      return run_animation(config, caption, animations_);
    }
    return run_shape(config, folder, caption, shapes_.empty(), shapes_);
  }

  // A sweep over drawings, shapes and animations shows all of them.
  Image render() const {
    std::vector<Image> images;
    if (!drawings_.empty()) images.push_back(drawings_.render());
    if (!shapes_.empty()) images.push_back(shapes_.render());
    if (!animations_.empty()) images.push_back(animations_.sheet());
    return images.size() == 1 ? images.front() : grid(images, 1);
  }
  std::vector<Image> sequence(int width) const { return animations_.sequence(width); }

 private:
  DrawingBook drawings_;
  PictureBook shapes_;
  AnimationBook animations_;
};

}  // namespace

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

std::string label(const MeasuredRun& run) {
  std::string text;
  for (const auto& [key, value] : run.settings) {
    const bool word = !value.empty() && std::isalpha(static_cast<unsigned char>(value.front())) &&
                      value != "true" && value != "false";
    const std::string name = word ? "" : key.substr(key.rfind('.') + 1) + " ";
    const bool fits = value.size() <= kLongestLabel;
    text += (text.empty() ? "" : ", ") + name + (fits ? value : value.substr(0, 12) + " …");
  }
  return text;
}

void check_experiment(const std::filesystem::path& path, const std::vector<Override>& overrides) {
  plan(path, overrides);
}

Outcome run_experiment(const std::filesystem::path& path, const std::vector<Override>& overrides,
                       const Progress& progress) {
  const auto [config, combinations, configs, roots, reference] = plan(path, overrides);
  Outcome outcome;
  outcome.config = config;
  outcome.resolved = to_node(outcome.config);
  Books books(outcome.config.picture);
  for (std::size_t i = 0; i < configs.size(); ++i) {
    MeasuredRun settings;
    settings.settings = combinations[i].settings;
    progress(i + 1, configs.size(), label(settings));
    const std::string caption = configs.size() > 1 ? label(settings) : "deformed";
    outcome.runs.push_back(with_lines_of(
        roots[i], [&] { return books.run(configs[i], path.parent_path(), caption); }));
    outcome.runs.back().measured.settings = settings.settings;
  }
  for (Run& run : outcome.runs) {
    if (reference) run.measured.metrics.merge(difference(run, outcome.runs[*reference]));
  }
  const std::vector<MeasuredRun> measured = with_seconds(outcome.runs);
  for (const Claim& claim : outcome.config.claims) outcome.claims.push_back(check(claim, measured));
  outcome.picture = books.render();
  outcome.frames = books.sequence(outcome.config.animation.sequence.width);
  return outcome;
}

}  // namespace deformlab
