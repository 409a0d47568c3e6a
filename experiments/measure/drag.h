#pragma once

#include <functional>

#include "deformers/deformer.h"
#include "experiments/measure/measurements.h"
#include "experiments/subjects/shape/edit.h"

namespace deformlab {

/// How the handles go to their targets: in small steps, as a user drags them. Each step is an
/// update that starts from the result of the last one.
struct DragOptions {
  int steps = 1;      ///< number of updates, in each of which the handles go the same distance
  bool back = false;  ///< whether they then return to their start in the same number of updates

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("steps", o.steps, {.min = 1, .max = 10'000},
                "The number of updates in which the handles go to their targets");
    visit("back", o.back,
          "Whether the handles then go back to where they began, in as many updates");
  }
};

/// The results of a drag: the report of its last update, and metrics of all its updates. These are
/// iterations_max, iterations_mean, and finite (0 if a vertex was not finite after an update, else
/// 1). The seconds are medians over the updates: seconds.update, and seconds.update.PHASE for each
/// phase of the solver.
struct DragReport {
  Report last;
  Metrics metrics, seconds;
};

/// The rest positions of handles.moved and then of handles.points, 3×# [length].
Eigen::Matrix3Xd targets_at_rest(const Shape& rest, const Handles& handles);

/// Moves the handles of a compiled deformer from where they are in `rest` to their targets, and
/// calls `after` after each update.
DragReport drag(
    Deformer& deformer, const Shape& rest, const ResolvedEdit& edit, const DragOptions& options,
    const std::function<void()>& after = [] {});

}  // namespace deformlab
