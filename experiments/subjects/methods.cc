#include "experiments/subjects/methods.h"

#include "geometry/core/error.h"

namespace deformlab {
namespace {

std::unique_ptr<Deformer> make_embedded(const Shape& rest,
                                        const EmbeddedDeformationOptions& options,
                                        std::span<const Cut> cuts = {}) {
  if (options.graph.adaptive.start == 0) {
    return std::make_unique<EmbeddedDeformation>(rest, options, cuts);
  }
  return std::make_unique<AdaptiveDeformation>(rest, options, cuts);
}

}  // namespace

std::unique_ptr<Deformer> make_deformer(const MethodOptions& options, const Shape& rest,
                                        std::span<const Cut> cuts) {
  const bool embedded = options.deformer == "embedded_deformation" || options.deformer == "auto";
  if (!embedded && !cuts.empty()) {
    throw InputError(cuts.front().name + ": deformer '" + options.deformer +
                     "' has no graph to cut; leave 'cut' out");
  }
  if (options.deformer == "rbf") return std::make_unique<RbfDeformation>(rest, options.rbf);
  if (options.deformer == "primo") return std::make_unique<PrimoDeformation>(rest, options.primo);
  if (options.deformer == "cgal_arap") return std::make_unique<CgalArap>(rest, options.arap);
  if (options.deformer == "arap_2d") {
    throw InputError("deformer 'arap_2d' is for drawings: give 'drawing', not 'shape'");
  }
  return make_embedded(rest, options.deformation, cuts);
}

std::unique_ptr<Deformer> make_deformer(const MethodOptions& options, const DrawingScene& scene) {
  if (options.deformer == "arap_2d" || options.deformer == "auto") {
    return std::make_unique<Arap2d>(scene.rest, scene.weights, options.arap_2d);
  }
  if (options.deformer == "embedded_deformation") {
    EmbeddedDeformationOptions in_the_plane = options.deformation;
    in_the_plane.dimension = 2;
    return make_embedded(to_shape(scene.rest), in_the_plane);
  }
  throw InputError("deformer '" + options.deformer +
                   "' is for shapes in space; a drawing takes arap_2d or embedded_deformation");
}

}  // namespace deformlab
