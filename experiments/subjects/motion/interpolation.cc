#include "experiments/subjects/motion/interpolation.h"

#include <algorithm>
#include <cmath>

namespace deformlab {
namespace {

using Numbers = Eigen::Array<double, PoseNumbers::RowsAtCompileTime, 1>;

double ease(double share) { return share * share * (3 - 2 * share); }

double way(FrameTime from, FrameTime to) { return static_cast<double>(to - from); }

class Spline {
 public:
  Spline(const std::vector<FrameTime>& times, const std::vector<PoseNumbers>& poses)
      : times_(times), poses_(poses), last_(times.size() - 1) {}

  PoseNumbers at(const Between& b) const {
    const double t = b.share, h = step(b.from);
    const Numbers rise = poses_[b.to] - poses_[b.from];
    const Numbers from = h * slope(b.from) - rise, to = rise - h * slope(b.to);
    const Numbers bend = t * (1 - t) * ((1 - t) * from + t * to);
    return poses_[b.from] + (t * rise + bend).matrix();
  }

 private:
  double step(std::size_t i) const { return way(times_[i], times_[i + 1]); }
  Numbers secant(std::size_t i) const { return (poses_[i + 1] - poses_[i]) / step(i); }

  // The slope at a key: 0 where the numbers turn back, and otherwise the weighted harmonic mean of
  // the secants on both sides.
  Numbers slope(std::size_t i) const {
    if (last_ == 1) return secant(0);
    if (i == 0) return at_end(secant(0), secant(1), step(0), step(1));
    if (i == last_) return at_end(secant(i - 1), secant(i - 2), step(i - 1), step(i - 2));
    const Numbers before = secant(i - 1), after = secant(i);
    const double wb = 2 * step(i) + step(i - 1), wa = step(i) + 2 * step(i - 1);
    const Numbers mean = (wb + wa) / (wb / before + wa / after);
    return (before * after > 0).select(mean, 0.0);
  }

  // A parabola's slope at its end, as far as it does not overshoot.
  static Numbers at_end(const Numbers& near, const Numbers& far, double h_near, double h_far) {
    const Numbers parabola = ((2 * h_near + h_far) * near - h_near * far) / (h_near + h_far);
    const Numbers bounded = parabola.abs().min(3 * near.abs()) * near.sign();
    return (parabola * near > 0).select(bounded, 0.0);
  }

  const std::vector<FrameTime>& times_;
  const std::vector<PoseNumbers>& poses_;
  std::size_t last_;
};

}  // namespace

Between between(const std::vector<FrameTime>& times, FrameTime moment) {
  const auto after =
      static_cast<std::size_t>(std::ranges::upper_bound(times, moment) - times.begin());
  if (after == 0) return {0, 0, 0};
  if (after == times.size()) return {after - 1, after - 1, 0};
  return {after - 1, after, way(times[after - 1], moment) / way(times[after - 1], times[after])};
}

PoseNumbers interpolated(const std::vector<FrameTime>& times, const std::vector<PoseNumbers>& poses,
                         FrameTime moment, Interpolation kind) {
  const Between b = between(times, moment);
  if (b.share == 0) return poses[b.from];
  if (kind == Interpolation::kSpline) return Spline(times, poses).at(b);
  const double share = kind == Interpolation::kSmooth ? ease(b.share) : b.share;
  return poses[b.from] + share * (poses[b.to] - poses[b.from]);
}

}  // namespace deformlab
