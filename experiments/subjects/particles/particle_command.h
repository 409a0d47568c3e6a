#pragma once

#include "experiments/subjects/animation/animate_options.h"

namespace deformlab {

/// `deformlab animate --particles`. The output has the rows of the input, in their order, and
/// appears whole or not at all.
int animate_particles(const AnimateFlags& flags, const AnimateOptions& options);

}  // namespace deformlab
