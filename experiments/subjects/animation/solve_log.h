#pragma once

#include "experiments/subjects/run.h"

namespace deformlab {

/// Gathers the reports of all frames of an animation into those of one run. Its seconds are means
/// of the frames that were solved, but for those of registration, which are paid once.
class SolveLog {
 public:
  void add(const Report& report, double size);  ///< `size` of the shape [length]
  Run run() const;                              ///< without metrics where nothing was solved

 private:
  Report last_;
  Metrics worst_;
  Metrics seconds_, least_seconds_;
  double iterations_ = 0, frames_ = 0;
  std::vector<std::string> notes_;
};

/// Into `metrics`, of each name the greater (or the smaller) of what is there and what comes.
void keep_greatest(Metrics& metrics, const Metrics& more);
void keep_least(Metrics& metrics, const Metrics& more);

}  // namespace deformlab
