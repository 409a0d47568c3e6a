#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "experiments/measure/measurements.h"

namespace deformlab {

/// Pins the motion of an edited animation against that of its input, of all points or some.
/// Frames are shown one after the other and forgotten. With v the input, ṽ the output, d = ṽ − v,
/// Δ the difference to the frame before, and root mean squares over points and frames:
///   displacement              of d [length]
///   displacement_change       Δd over Δv: 0 where the edit is the same in all frames
///   displacement_change_max   the same of the worst frame, over the mean Δv
///   unsteadiness              Δ²d over Δ²v: what flickers or jumps
///   unsteadiness_max          the same of the worst frame, over the mean Δ²v
///   motion_kept               Σ Δv·Δṽ / Σ |Δv|²: 1 where the motion is kept
///   fast_motion_kept          the same of Δ², in which fast motion weighs more
///   fast_motion_correlation   the cosine of Δ²v and Δ²ṽ over all
/// What needs two or three frames in a row is left out where there are none.
class Coherence {
 public:
  explicit Coherence(std::vector<int> points = {}) : points_(std::move(points)) {}

  void add(const Eigen::Matrix3Xd& input, const Eigen::Matrix3Xd& output);  ///< 3×n [length]
  void interrupt() { last_.clear(); }  ///< the next frame does not follow the last
  Metrics metrics(const std::string& prefix = "") const;

 private:
  struct Frame {
    Eigen::Matrix3Xd v, w;  // input and output
  };
  struct Sums {
    double vv = 0, ww = 0, vw = 0, dd = 0, dd_most = 0;
    int frames = 0;
    void add(const Frame& change);
  };

  std::vector<int> points_;
  double n_ = 0;             // points of a frame
  std::vector<Frame> last_;  // at most two, the latest first
  Sums places_, changes_, bends_;
};

/// The angle of the rotation that takes points best to others, both 3×n [degrees].
double turn_between(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

}  // namespace deformlab
