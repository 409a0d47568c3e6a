#include "experiments/subjects/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "experiments/config/config.h"
#include "geometry/core/options.h"

namespace deformlab {
namespace {

// Calls action(). Errors of a method's options then name them as a config does.
template <class Action>
std::unique_ptr<Deformer> made(DeformerKind kind, Action&& make) {
  return inside_option(name_of(kind), make);
}

std::unique_ptr<Deformer> make_embedded(const MethodOptions& options, const Shape& rest,
                                        std::span<const Cut> cuts) {
  if (options.adaptive.start == 0) {
    return std::make_unique<EmbeddedDeformation>(rest, options.deformation, cuts);
  }
  return std::make_unique<AdaptiveDeformation>(rest, options.deformation, options.adaptive, cuts);
}

// A vertex is as stiff as the stiffest triangle around it.
Eigen::VectorXd vertex_stiffness(const DrawingScene& scene) {
  if ((scene.weights.array() == 1).all()) return {};
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(scene.rest.V.cols());
  for (Eigen::Index f = 0; f < scene.rest.F.cols(); ++f) {
    for (const int i : scene.rest.F.col(f)) stiffness[i] = std::max(stiffness[i], scene.weights[f]);
  }
  return (stiffness.array() > 0).select(stiffness, 1);
}

[[noreturn]] void reject(DeformerKind kind, const char* why) {
  throw OptionError("deformer", std::string(name_of(kind)), why);
}

}  // namespace

DeformerKind method_that_reads(std::string_view key) {
  for (const auto& [kind, name] : names_of(DeformerKind())) {
    if (name == key) return kind;
  }
  return DeformerKind::kEmbeddedDeformation;
}

bool is_without_effect(std::string_view key, DeformerKind method) {
  FieldNames keys;
  const MethodOptions options;
  MethodOptions::fields(options, keys);
  const bool known = key != "deformer" && std::ranges::find(keys.names, key) != keys.names.end();
  return known && method_that_reads(key) != method;
}

std::unique_ptr<Deformer> make_deformer(const MethodOptions& options, const Shape& rest,
                                        std::span<const Cut> cuts) {
  using enum DeformerKind;
  const DeformerKind kind = options.deformer;
  if (kind == kAuto || kind == kEmbeddedDeformation) return make_embedded(options, rest, cuts);
  if (kind == kArap2d) reject(kind, ", which is for drawings: give 'drawing', not 'shape'");
  if (options.deformation.stiffness.size() > 0) {
    throw InputError(
        fmt::format("deformer '{}' has no stiffness; leave 'paint' out", name_of(kind)));
  }
  if (!cuts.empty()) {
    throw InputError(fmt::format("{}: deformer '{}' has no graph to cut; leave 'cut' out",
                                 cuts.front().name, name_of(kind)));
  }
  return made(kind, [&]() -> std::unique_ptr<Deformer> {
    if (kind == kRbf) return std::make_unique<RbfDeformation>(rest, options.rbf);
    if (kind == kPrimo) return std::make_unique<PrimoDeformation>(rest, options.primo);
    return std::make_unique<CgalArap>(rest, options.cgal_arap);
  });
}

std::unique_ptr<Deformer> make_deformer(const MethodOptions& options, const DrawingScene& scene) {
  using enum DeformerKind;
  if (options.deformer == kAuto || options.deformer == kArap2d) {
    return made(kArap2d, [&] {
      return std::make_unique<Arap2d>(scene.rest, scene.weights, options.arap_2d);
    });
  }
  if (options.deformer == kEmbeddedDeformation) {
    MethodOptions in_the_plane = options;
    in_the_plane.deformation.dimension = 2;
    in_the_plane.deformation.stiffness = vertex_stiffness(scene);
    return make_embedded(in_the_plane, to_shape(scene.rest), {});
  }
  reject(options.deformer,
         ", which is for shapes in space; a drawing takes arap_2d or embedded_deformation");
}

}  // namespace deformlab
