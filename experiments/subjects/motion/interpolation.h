#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "experiments/subjects/shape/edit_motion.h"
#include "geometry/core/enum_names.h"

namespace deformlab {

/// A moment of an animation, counted in frames. Every number of a frame is one.
using FrameTime = long double;

/// How a handle goes from one keyframe to the next: in proportion to time, slowly at both ends, or
/// by a monotone cubic, whose speed has no jumps and which never overshoots a key.
enum class Interpolation { kLinear, kSmooth, kSpline };
constexpr auto names_of(Interpolation) {
  using enum Interpolation;
  return std::to_array<EnumName<Interpolation>>(
      {{kLinear, "linear"}, {kSmooth, "smooth"}, {kSpline, "spline"}});
}

/// The two keys around a moment, which may be the same, and the share of the way between them.
struct Between {
  std::size_t from, to;
  double share;
};

/// `times` ascend. Before the first and after the last of them, both keys are that one.
Between between(const std::vector<FrameTime>& times, FrameTime moment);

/// The pose at a moment among the poses at `times`. Each number of a pose is interpolated by
/// itself, so that an angle may exceed a half turn. A spline is the monotone cubic of Fritsch and
/// Butland (1984): between two keys each number stays between those of the keys.
PoseNumbers interpolated(const std::vector<FrameTime>& times, const std::vector<PoseNumbers>& poses,
                         FrameTime moment, Interpolation kind);

}  // namespace deformlab
