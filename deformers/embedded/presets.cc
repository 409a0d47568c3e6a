#include "deformers/embedded/presets.h"

namespace deformlab {

EmbeddedDeformationOptions preset_options(Preset preset) {
  EmbeddedDeformationOptions options;
  if (preset == Preset::kSumner2007) return options;
  options.graph.fit = true;
  options.graph.region = NodeRegion::kActive;
  options.graph.distance = NodeDistance::kPathAware;
  options.graph.neighbors = 8;
  options.graph.alpha = EdgeWeights::kLength;
  options.graph.interior = InteriorNodes::kAuto;
  options.energies["rotation"].weight = 100;
  options.energies["regularization"].weight = 10;
  options.energies["constraint"].weight = 1e6;
  options.border = Border::kSoft;
  options.start = Start::kHarmonic;
  options.relaxed_constraint = 1e4;
  options.hold_angles = true;
  return options;
}

}  // namespace deformlab
