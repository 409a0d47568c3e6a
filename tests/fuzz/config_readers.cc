#include <set>

#include "deformers/arap_2d/arap_2d.h"
#include "deformers/embedded/embedded_deformation.h"
#include "deformers/embedded/presets.h"
#include "experiments/config/config.h"
#include "experiments/config/override.h"
#include "experiments/subjects/drawing/plane_edit.h"
#include "experiments/subjects/experiment.h"
#include "experiments/subjects/motion/script.h"
#include "experiments/subjects/shape/edit.h"
#include "tests/fuzz/readers.h"
#include "tests/support/animations.h"
#include "tests/support/drawings.h"
#include "tests/support/scenes.h"

// What is written in YAML: configs, edits of all subjects, and values on the command line.
namespace deformlab::fuzz {
namespace {

/// A value that is written as YAML is read again as the same value.
void read_yaml(const std::string& bytes) {
  const auto source = std::make_shared<const ConfigSource>(ConfigSource{"a.yaml", "."});
  const std::string written = to_yaml(parse_yaml(bytes, source));
  expect(to_yaml(parse_yaml(written, source)) == written, "YAML that was written is read again");
}

void read_config_file(const std::string& bytes) { plan_experiment(put("config.yaml", bytes), {}); }

void read_override(const std::string& bytes) {
  static const std::filesystem::path config = put("overridden.yaml", test::kExperiment);
  plan_experiment(config, {parse_override(bytes)});
}

/// The options of a command that got the edit.
RunOptions options_of(void (*load)(const std::filesystem::path&, ConfigNode&),
                      const std::string& bytes) {
  ConfigNode root;
  root.kind = ConfigNode::Kind::kMap;
  load(put("edit.yaml", bytes), root);
  return read_run_options(root);
}

void deform(Deformer& deformer, const ResolvedEdit& edit) {
  deformer.compile(edit.handles);
  deformer.update(edit.targets);
  expect(deformer.deformed().V.allFinite(), "a deformed shape is finite");
}

void read_shape_edit(const std::string& bytes) {
  const Shape rest = test::bumpy_plane(4);
  const ResolvedEdit edit = resolve(read_edit(options_of(put_edit, bytes).edit), rest);
  EmbeddedDeformationOptions options = preset_options();
  options.graph.nodes = 6;
  EmbeddedDeformation deformer(rest, options);
  deform(deformer, edit);
}

void read_drawing_edit(const std::string& bytes) {
  const Triangulation rest = test::grid_mesh(4, {0, 0}, {9, 9});
  const auto belongs = [](const Eigen::Vector2d& point) { return point.norm() < 20; };
  const auto entries = read_plane_edit(options_of(put_edit, bytes).edit);
  const ResolvedEdit edit =
      with_circles([&] { return resolve(on_mesh(entries, rest, belongs), rest); });
  Arap2d deformer(rest, {}, {});
  deform(deformer, edit);
}

void read_animation_edit(const std::string& bytes) {
  const RunOptions options = options_of(put_script, bytes);
  read_script(options.edit, options.animation.keyframes);
}

Texts yaml_samples() {
  return {test::kExperiment, "a: &b [1, 'two', \"three\\n\", ~]\nc: *b\nd: {e: !!str 5, f: [[]]}\n",
          "- |\n  text\n  of lines\n- >-\n  folded\n- ? key\n  : value\n"};
}

Texts config_samples() {
  return {
      test::kExperiment,
      "drawing: {file: a.png, vertices: 50}\ncut: []\npaint:\n  - {select: {circle: {center: [1, "
      "2], radius: 3}}, weight: 5}\nedit:\n  - {select: {point: [1, 2]}, fix: true}\n  - "
      "{select: {point: [3, 4]}, by: [1, 0], rotate: 20}\n"
      "depth: {parts: []}\noutput: {page: keep}\n",
      "animation: {generator: gallop, frames: 3, pictured: 2, keyframes: [{frame: 0, edit: "
      "[{select: {nearest: "
      "[0, 0, 0]}, by: [0, 0, 0.1]}]}]}\nedit:\n  - {select: {all: true}, fix: true}\n",
      "preset: sumner_2007\nenergies: {rotation: 1, regularization: {weight: 10}}\nlosses: "
      "{constraint: "
      "{kind: huber, scale: 1}}\nsolver: {method: ceres}\nedit:\n  - {select: {vertices: [0]}, "
      "to: [0, 0, 1], weight: 2}\nsweep: {graph.nodes: [10, 20], solver.method: [ceres, "
      "gauss_newton]}\nclaims:\n  - {name: a, measure: steps, at_most: 9, over: worst, where: "
      "{graph.nodes: [10]}}\nmeasure: {edit: true, probes: [[0, 0, 0]], reference: {graph.nodes: "
      "10, solver.method: ceres}}\n"};
}

Texts edit_samples() {
  return {
      test::kLift,
      "edit:\n  - {select: {vertices: [0, 1]}, scale: {factor: [1, 2, 3]}, rotate: {axis: [0, 0, "
      "1], degrees: 90, center: [0, 0, 0]}, by: [1, 0, 0]}\n",
      "edit:\n  - {select: {sphere: {center: [0, 0, 0], radius: 0.5}}, matrix: [[1, 0, 0, 0], [0, "
      "1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}\n  - {select: {point: [0.4, 0.5, 0]}, to: [1, 1, "
      "1], weight: 3}\n"};
}

Texts plane_edit_samples() {
  return {
      "edit:\n  - {select: {point: [1, 1]}, fix: true}\n  - {select: {point: [7, 8]}, by: "
      "[-6, 2], rotate: -30}\n",
      "edit:\n  - {select: {circle: {center: [4, 4], radius: 3}}, scale: {factor: 2}}\n  - "
      "{select: {nearest: [0, 0]}, to: [1, 1]}\n"};
}

Texts script_samples() {
  return {test::kTubeEdit,
          "pose: 3\ninterpolation: smooth\nkeyframes:\n  - frame: 0\n    edit:\n      - {select: "
          "{all: true}, by: [0, 0, 1]}\n  - frame: 9\n    edit:\n      - {select: {vertices: [0]}, "
          "rotate: {axis: [1, 0, 0], degrees: 5}}\n"};
}

Texts override_samples() {
  return {"graph.nodes=425", "edit.1.by=[0, 0, 1]", "sweep={graph.nodes: [10, 20]}",
          "picture.direction=[1, 2, 3]", "energies.rotation={weight: 2}"};
}

const Texts kYamlWords{": ",    "- ",   "[",         "]",      "{",    "}",
                       "&a ",   "*a",   "!!str ",    "!!int ", "<<: ", "---\n",
                       "...\n", "|\n",  ">-\n",      "? ",     "\"",   "'",
                       "\\x41", "\n  ", "%YAML 1.2", "~",      "null", "true",
                       "false", ".nan", ".inf",      "1e300",  "0x10", "2147483648"};

/// The parts of all dotted keys.
template <class Options>
void add_names(std::set<std::string>& names) {
  for (const FieldHelp& field : describe<Options>()) {
    std::size_t begin = 0;
    while (begin < field.name.size()) {
      const std::size_t end = std::min(field.name.find_first_of(".[]", begin), field.name.size());
      if (end > begin) names.insert(field.name.substr(begin, end - begin));
      begin = end + 1;
    }
  }
}

/// The grammar of YAML, and every key of a config and of an edit.
Texts config_words() {
  std::set<std::string> names{"circle"};
  add_names<ExperimentConfig>(names);
  add_names<EditEntry>(names);
  Texts words = kYamlWords;
  words.insert(words.end(), names.begin(), names.end());
  return words;
}

}  // namespace

std::vector<Reader> config_readers() {
  return {{"yaml", read_yaml, yaml_samples, [] { return kYamlWords; }},
          {"config", read_config_file, config_samples, config_words},
          {"override", read_override, override_samples, config_words},
          {"edit", read_shape_edit, edit_samples, config_words},
          {"drawing_edit", read_drawing_edit, plane_edit_samples, config_words},
          {"animation_edit", read_animation_edit, script_samples, config_words}};
}

}  // namespace deformlab::fuzz
