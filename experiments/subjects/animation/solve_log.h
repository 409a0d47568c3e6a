#pragma once

#include <string>
#include <vector>

#include "experiments/subjects/subject.h"

namespace deformlab {

/// Gathers the reports of all solves of an animation into those of one run. The notes of each are
/// logged with the first frame that has them, unless the frame before had them too.
class SolveLog {
 public:
  void add(int frame, const Report& report, double size);  ///< `size` of the shape [length]

  int solves() const { return solves_; }
  const Report& last() const { return last_; }

  /// The metrics are those of the last solve, but for converged, min_det_R, inside_out, iterations,
  /// handle_rms and handle_max, which are the worst of all; and iterations_mean and solves. The
  /// seconds are means over the solves, except those of registration, which is done once. Without
  /// metrics where nothing was solved.
  Run run() const;

 private:
  void warn(int frame, const Report& report);

  Report last_;
  Metrics worst_;
  Metrics seconds_, least_seconds_;
  double iterations_ = 0;
  int solves_ = 0;
  std::vector<std::string> notes_;  // of all frames, each once
  std::vector<std::string> notes_of_last_;
};

/// For each name, `metrics` keeps the greater (or the smaller) of its own value and the new one.
void keep_greatest(Metrics& metrics, const Metrics& more);
void keep_least(Metrics& metrics, const Metrics& more);

}  // namespace deformlab
