#include "experiments/subjects/animation/animate_options.h"

#include <algorithm>

#include "experiments/config/config.h"
#include "experiments/config/override.h"
#include "experiments/subjects/animation/animation_pictures.h"
#include "experiments/subjects/run.h"

namespace deformlab {

namespace {

void set_defaults_of_particles(ConfigNode& root, const std::vector<std::string>& overrides) {
  apply_override(root, {"energies.smoothness", "1", "."});
  const bool names_solver = std::ranges::any_of(
      overrides, [](const std::string& text) { return text.starts_with("solver"); });
  if (!names_solver) apply_override(root, {"solver.linear_solver", "kronecker_cg", "."});
}

}  // namespace

AnimateOptions read_animate_options(const std::vector<std::string>& overrides,
                                    const AnimateFlags& flags) {
  ConfigNode root;
  root.kind = ConfigNode::Kind::kMap;
  apply_override(root, {"graph.nodes", std::to_string(flags.nodes), "."});
  if (flags.frames.empty()) set_defaults_of_particles(root, overrides);
  for (const std::string& text : overrides) apply_override(root, parse_override(text));
  auto options = read_config<AnimateOptions>(root);
  complete_energies(root, options.deformation);
  check(options.picture);
  return options;
}

}  // namespace deformlab
