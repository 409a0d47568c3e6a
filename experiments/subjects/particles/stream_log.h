#pragma once

#include "experiments/subjects/animation/solve_log.h"
#include "experiments/subjects/particles/stream_editor.h"
#include "experiments/subjects/particles/stream_measurements.h"

namespace deformlab {

/// What is told of edited particles, gathered while their frames go by and are forgotten.
class StreamLog {
 public:
  void add(const StreamEditor& editor, ParticleFrame rows, const Eigen::Matrix3Xd& edited);

  /// The metrics of SolveLog, StreamMeasurements and twist_of, handles, vertices (the particles of
  /// a frame in the mean), and node_motion: how far the nodes go in the mean, as a part of their
  /// bounding box's diagonal. Of the seconds of a frame's particles the least: seconds.weights and
  /// seconds.transfer.
  Run run(const StreamEditor& editor) const;

 private:
  SolveLog solves_;
  StreamMeasurements measurements_;
  Metrics least_seconds_;
  int seen_ = 0;  // of the editor's solves
};

}  // namespace deformlab
