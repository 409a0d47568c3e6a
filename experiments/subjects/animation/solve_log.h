#pragma once

#include <string>
#include <vector>

#include "experiments/subjects/animation/frame_pattern.h"
#include "experiments/subjects/subject.h"

namespace deformlab {

/// Combines the reports of all solves of an animation into one run. Logs each note with its frame,
/// unless the frame before had the same note.
class SolveLog {
 public:
  void add(FrameNumber frame, const Report& report, double size);  ///< `size` of the shape [length]

  int solves() const { return solves_; }
  const Report& last() const { return last_; }

  /// The metrics are those of the last solve, with iterations_mean and solves. Of converged,
  /// min_det_R, inside_out, iterations, handle_rms and handle_max they have the worst values of all
  /// solves. The seconds are means over the solves, except those of registration and transfer,
  /// which are the least ones. There are no metrics if nothing was solved.
  Run run() const;

 private:
  void warn(FrameNumber frame, const Report& report);

  Report last_;
  Metrics worst_;
  Metrics seconds_, least_seconds_;
  double iterations_ = 0;
  int solves_ = 0;
  std::vector<std::string> notes_;  // of all frames, each once
  std::vector<std::string> notes_of_last_;
};

/// Each metric keeps the greater (or the smaller) of its old and its new value.
void keep_greatest(Metrics& metrics, const Metrics& more);
void keep_least(Metrics& metrics, const Metrics& more);

}  // namespace deformlab
