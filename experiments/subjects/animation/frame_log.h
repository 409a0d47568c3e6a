#pragma once

#include "experiments/subjects/animation/mesh_measurements.h"
#include "experiments/subjects/animation/solve_log.h"

namespace deformlab {

/// What is told of the frames of a mesh sequence while they are made, and forgotten. Warnings go to
/// the log with the first frame that they are of, unless the one before had them too.
class FrameLog {
 public:
  /// `size` of the shape [length]. Whether shapes are measured, too, which takes its time.
  FrameLog(double size, bool measures) : size_(size), measures_(measures) {}

  void add(int frame, const Report& report, const Shape& input, const Shape& output);
  void pass();  ///< a frame that an earlier run has made, of which nothing is known

  /// What was measured of the frames that were added; their number is solves, that of all frames.
  /// A note tells of those that were passed.
  Run run() const;
  void print(const std::string& out) const;

 private:
  void warn(int frame, const Report& report);

  double size_;
  bool measures_;
  int made_ = 0, passed_ = 0;
  SolveLog solves_;
  MeshMeasurements measurements_;
  std::vector<std::string> notes_;  // of the last frame
};

}  // namespace deformlab
