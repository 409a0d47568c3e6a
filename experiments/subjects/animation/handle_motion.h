#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/subjects/animation/frame_pattern.h"
#include "experiments/subjects/animation/script.h"

namespace deformlab {

/// The handles of an edited animation, and their offsets from the input in each frame.
class HandleMotion {
 public:
  /// Each edit is applied to the pose that it refers to, and becomes translational offsets there
  /// (Sumner et al. 2007, section 5, "Mesh animations"). The offsets are interpolated between the
  /// keyframes that name a handle, and constant before the first and after the last. `pose_of`
  /// gives the shape in a frame. Throws InputError as `resolve` does, for a keyframe or pose that
  /// is not a frame of the range, and for a vertex that one edit moves and another fixes or moves
  /// in all frames.
  HandleMotion(const Script& script, const FrameRange& range,
               const std::function<Shape(int)>& pose_of);

  /// Fixed vertices are fixed in all frames, at their positions in the input.
  const Handles& handles() const { return handles_; }
  /// The offsets of handles().moved and then of handles().points in a frame, 3×# [length].
  Eigen::Matrix3Xd offsets(double frame) const;
  std::string description() const;  ///< all handles and offsets as text, for a fingerprint

 private:
  struct Key {
    int frame;
    Eigen::Vector3d offset;
  };
  struct Channel {
    std::vector<Key> keys;  // by frame; an edit of all frames has one key
    std::string where;      // the first edit that names it
    bool always;
  };
  using Point = std::array<double, 3>;

  void add(const TimedEdit& edit, const Shape& pose);
  void fix(int vertex, const TimedEdit& edit);
  void add_key(Channel& channel, const TimedEdit& edit, const Eigen::Vector3d& offset,
               const std::string& what);
  void collect();
  Eigen::Vector3d offset(const Channel& channel, double frame) const;

  bool smooth_;
  std::map<int, Channel> vertices_;
  std::map<Point, Channel> points_;
  std::map<int, std::string> fixed_;  // vertices, and the edits that fix them
  Handles handles_;
};

}  // namespace deformlab
