#pragma once

#include <functional>

#include "deformers/deformer.h"
#include "experiments/measure/measurements.h"
#include "experiments/subjects/shape/edit.h"

namespace deformlab {

/// How the handles come to their targets: a user's hand drags them there in small steps, each an
/// update that starts from the last.
struct DragOptions {
  int steps = 1;      ///< updates, the handles going the same way in each
  bool back = false;  ///< and as many back to where they began

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("steps", o.steps, {.min = 1, .max = 10'000},
                "The number of updates in which the handles go to their targets");
    visit("back", o.back,
          "Whether the handles then go back to where they began, in as many updates");
  }
};

/// What a drag did: of its last update the report, of all of them iterations_max and
/// iterations_mean, finite (1, or 0 where a vertex ever was not), seconds.update, the median
/// of each, and seconds.update.PHASE, that of the solver's phases.
struct DragReport {
  Report last;
  Metrics metrics, seconds;
};

/// Moves the handles of a compiled deformer from their places in `rest` to their targets; `after`
/// is called after each update.
DragReport drag(
    Deformer& deformer, const Shape& rest, const ResolvedEdit& edit, const DragOptions& options,
    const std::function<void()>& after = [] {});

}  // namespace deformlab
