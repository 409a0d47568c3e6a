#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/subjects/animation/frame_pattern.h"
#include "experiments/subjects/animation/script.h"
#include "experiments/subjects/shape/edit_motion.h"

namespace deformlab {

/// The handles of an edited animation, and their offsets from the input in each frame.
class HandleMotion {
 public:
  /// Each edit is applied to the pose that it refers to, and becomes translational offsets there
  /// (Sumner et al. 2007, section 5, "Mesh animations"). Between the keyframes that name a handle
  /// its motion is interpolated, so that it turns along an arc and by any angle. Before the first
  /// and after the last its offset is constant. `pose_of` gives the shape in a frame. Throws
  /// InputError as `resolve` does, for a keyframe or pose that is not a frame of the range, and for
  /// a vertex that one edit moves and another fixes or moves in all frames.
  HandleMotion(const Script& script, const FrameRange& range,
               const std::function<Shape(FrameNumber)>& pose_of);

  /// Fixed vertices are fixed in all frames, at their positions in the input. Handles that move
  /// together in all edits are a group.
  const Handles& handles() const { return handles_; }
  /// The offsets of handles().moved and then of handles().points in a frame, 3×# [length].
  Eigen::Matrix3Xd offsets(FrameNumber frame) const;
  /// How these handles turn in a frame, as in Handles; 3×0 if no edit turns any.
  Eigen::Matrix3Xd rotations(FrameNumber frame) const;
  std::string description() const;  ///< all handles and offsets as text, for a fingerprint

 private:
  struct Key {
    FrameNumber frame;
    Pose pose;
    int group;      // of all groups of all edits
    double weight;  // in E_con
  };
  // The two keys around a frame, which may be the same, and the share of the way between them.
  struct Between {
    const Key &from, &to;
    double share;
  };
  struct Channel {
    std::vector<Key> keys;  // by frame; an edit of all frames has one key
    std::string where;      // the first edit that names it
    bool always;
  };
  using Point = std::array<double, 3>;

  void add(const TimedEdit& edit, const Shape& pose);
  void fix(int vertex, const TimedEdit& edit);
  void add_key(Channel& channel, const TimedEdit& edit, const Key& key, const std::string& what);
  void collect();
  Between between(const Channel& channel, FrameNumber frame) const;
  // A matrix of one column for each handle: column(channel).
  template <class Column>
  Eigen::Matrix3Xd columns(Column&& column) const;

  bool smooth_;
  bool turns_ = false;  // an edit rotates
  int groups_ = 0;      // of all edits so far
  std::map<int, Channel> vertices_;
  std::map<Point, Channel> points_;
  std::map<int, std::string> fixed_;  // vertices, and the edits that fix them
  Handles handles_;
};

}  // namespace deformlab
