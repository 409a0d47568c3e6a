#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "experiments/measure/measurements.h"

namespace deformlab {

/// Compares the motion of an edited animation with that of its input, at all points or at some.
/// Frames are added one after the other, and only the last two are kept. v is the input, ṽ the
/// output, d = ṽ − v, and Δ the difference to the frame before. Means are root mean squares over
/// points and frames:
///   displacement              of d [length]
///   displacement_change       Δd over Δv: 0 if the edit is the same in all frames
///   displacement_change_max   the same of the worst frame, over the mean Δv
///   unsteadiness              Δ²d over Δ²v: greater if the edit flickers or jumps
///   unsteadiness_max          the same of the worst frame, over the mean Δ²v
///   motion_kept               Σ Δv·Δṽ / Σ |Δv|²: 1 if the motion is kept
///   fast_motion_kept          the same of Δ², in which fast motion counts more
///   fast_motion_correlation   the cosine of Δ²v and Δ²ṽ over all
/// Metrics that need two or three consecutive frames are left out if there are none.
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

/// The angle of the rotation that best takes `from` to `to`, both 3×n [degree].
double turn_between(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

/// Measures the frames of a mesh animation, which are added one after the other: Coherence, and the
/// distortion from the input to the output in the worst frame. For a region of vertices it measures
/// the same with `region.` before the names, and the least and greatest angle of the rotation that
/// takes the input best to the output, region.turn_min and region.turn_max [degree].
class MeshMeasurements {
 public:
  explicit MeshMeasurements(std::vector<int> region = {})
      : region_(std::move(region)), coherence_of_region_(region_) {}

  void add(const Shape& input, const Shape& output);
  void interrupt();  ///< the next frame does not follow the last
  Metrics metrics() const;

 private:
  std::vector<int> region_;
  Coherence coherence_, coherence_of_region_;
  Metrics greatest_, least_;
};

}  // namespace deformlab
