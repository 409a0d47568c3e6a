#pragma once

#include "deformers/embedded/embedded_options.h"

namespace deformlab {

/// Sets of options that belong together. kDefault suits most shapes and edits. kSumner2007 is what
/// Sumner et al. 2007 describe: k = 4, nodes spread over the whole shape, α_jk = 1, the weights
/// 1, 10 and 100, and Eq. 9 for the fixed part.
enum class Preset { kDefault, kSumner2007 };
constexpr auto names_of(Preset) {
  using enum Preset;
  return std::to_array<EnumName<Preset>>({{kDefault, "default"}, {kSumner2007, "sumner_2007"}});
}

/// The options of a preset. docs/presets.md gives the reason for each value of kDefault.
EmbeddedDeformationOptions preset_options(Preset preset = Preset::kDefault);

}  // namespace deformlab
