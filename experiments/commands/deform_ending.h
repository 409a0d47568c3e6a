#pragma once

#include <functional>

#include "deformers/deformer.h"
#include "experiments/commands/commands.h"
#include "render/image.h"

namespace deformlab {

/// Tells a report's notes, and that its solve stopped short or failed. False where it failed:
/// nothing is to be written then.
bool has_ended_well(const Report& report);

/// Writes what `deform` was asked for, be it of a shape or of a drawing. `draw` makes the picture,
/// where there is to be one, before the first file is written, as it may fail; `write` writes what
/// was deformed, which may still be refused; then come --metrics and --picture.
void write_deformed(const Report& report, const DeformFlags& flags,
                    const std::function<Image()>& draw, const std::function<void()>& write);

}  // namespace deformlab
