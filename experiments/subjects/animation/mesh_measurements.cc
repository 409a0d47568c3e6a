#include "experiments/subjects/animation/mesh_measurements.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/subjects/animation/solve_log.h"

namespace deformlab {
namespace {

double ratio(double a, double b) { return b > 0 ? a / b : 0; }

}  // namespace

void Coherence::Sums::add(const Frame& f) {
  vv += f.v.squaredNorm();
  ww += f.w.squaredNorm();
  vw += f.v.cwiseProduct(f.w).sum();
  const double d = (f.w - f.v).squaredNorm();
  dd += d;
  dd_most = std::max(dd_most, d);
  ++frames;
}

void Coherence::add(const Eigen::Matrix3Xd& input, const Eigen::Matrix3Xd& output) {
  Frame now{input, output};
  if (!points_.empty()) now = {input(Eigen::all, points_), output(Eigen::all, points_)};
  n_ = static_cast<double>(now.v.cols());
  places_.add(now);
  if (!last_.empty()) changes_.add({now.v - last_[0].v, now.w - last_[0].w});
  if (last_.size() == 2) {
    bends_.add({now.v - 2 * last_[0].v + last_[1].v, now.w - 2 * last_[0].w + last_[1].w});
    last_.pop_back();
  }
  last_.insert(last_.begin(), std::move(now));
}

Metrics Coherence::metrics(const std::string& prefix) const {
  const auto worst = [](const Sums& s) { return std::sqrt(ratio(s.dd_most * s.frames, s.vv)); };
  Metrics m;
  if (places_.frames > 0) m["displacement"] = std::sqrt(ratio(places_.dd, n_ * places_.frames));
  if (changes_.frames > 0) {
    m["displacement_change"] = std::sqrt(ratio(changes_.dd, changes_.vv));
    m["displacement_change_max"] = worst(changes_);
    m["motion_kept"] = ratio(changes_.vw, changes_.vv);
  }
  if (bends_.frames > 0) {
    m["unsteadiness"] = std::sqrt(ratio(bends_.dd, bends_.vv));
    m["unsteadiness_max"] = worst(bends_);
    m["fast_motion_kept"] = ratio(bends_.vw, bends_.vv);
    m["fast_motion_correlation"] = ratio(bends_.vw, std::sqrt(bends_.vv * bends_.ww));
  }
  Metrics result;
  for (const auto& [name, value] : m) result[prefix + name] = value;
  return result;
}

double turn_between(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  const Eigen::Matrix3d R = Eigen::umeyama(from, to, false).topLeftCorner<3, 3>();
  return Eigen::AngleAxisd(R).angle() * 180 / std::numbers::pi;
}

void MeshMeasurements::add(const Shape& input, const Shape& output) {
  coherence_.add(input.V, output.V);
  keep_greatest(greatest_, distortion(input, output));
  if (region_.empty()) return;
  coherence_of_region_.add(input.V, output.V);
  const double turn = turn_between(input.V(Eigen::all, region_), output.V(Eigen::all, region_));
  keep_greatest(greatest_, {{"region.turn_max", turn}});
  keep_greatest(greatest_, region_distortion(input, output, region_));
  keep_least(least_, {{"region.turn_min", turn}});
}

void MeshMeasurements::interrupt() {
  coherence_.interrupt();
  coherence_of_region_.interrupt();
}

Metrics MeshMeasurements::metrics() const {
  Metrics all = coherence_.metrics();
  all.insert(greatest_.begin(), greatest_.end());
  all.insert(least_.begin(), least_.end());
  if (!region_.empty()) all.merge(coherence_of_region_.metrics("region."));
  return all;
}

}  // namespace deformlab
