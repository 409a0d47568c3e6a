#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/subjects/animation/frame_pattern.h"
#include "experiments/subjects/motion/script.h"
#include "experiments/subjects/shape/edit_motion.h"

namespace deformlab {

/// What entries select and do in a pose, and where the handles with targets are in it, 3×#.
struct PosedEdit {
  ResolvedEdit edit;
  Eigen::Matrix3Xd rest;
};
using Resolve = std::function<PosedEdit(const std::vector<EditEntry>&, FrameNumber)>;

/// The handles of an edited animation, and their offsets from the input in each frame.
class HandleMotion {
 public:
  /// Each edit is applied to the pose that it refers to, and becomes translational offsets there
  /// (Sumner et al. 2007, section 5, "Mesh animations"). Between the keyframes that name a handle
  /// its motion is interpolated, so that it turns along an arc and by any angle. Before the first
  /// and after the last its offset is constant. `pose_of` gives the shape in a frame. Throws
  /// InputError as `resolve` does, for a keyframe or pose that is not a frame of the range, and for
  /// a vertex that one edit moves and another fixes or moves in all frames. Poses that a cursor
  /// blends have to name each handle that one of them names.
  HandleMotion(const Script& script, const FrameRange& range,
               const std::function<Shape(FrameNumber)>& pose_of);
  /// The same, where `resolve_in` resolves entries in the pose of a frame.
  HandleMotion(const Script& script, const FrameRange& range, const Resolve& resolve_in);

  /// Fixed vertices are fixed in all frames, at their positions in the input. Handles that move
  /// together in all edits are a group.
  const Handles& handles() const { return handles_; }
  /// The offsets of handles().moved and then of handles().points in a frame, 3×# [length].
  Eigen::Matrix3Xd offsets(FrameNumber frame) const;
  /// The same of one of the poses that a cursor blends, by its number from 0.
  Eigen::Matrix3Xd offsets_of_pose(std::size_t pose) const;
  /// How these handles turn in a frame, as in Handles; 3×0 if no edit turns any.
  Eigen::Matrix3Xd rotations(FrameNumber frame) const;
  std::string description() const;  ///< all handles and offsets as text, for a fingerprint

 private:
  struct Key {
    FrameTime moment;
    Pose pose;
    int group;      // of all groups of all edits
    double weight;  // in E_con
  };
  struct Channel {
    std::vector<Key> keys;  // by moment; an edit of all frames has one key
    std::string where;      // the last edit that names it
    bool always;
    std::vector<FrameTime> moments;    // of the keys
    std::vector<PoseNumbers> numbers;  // of their poses
  };
  using Point = std::array<double, 3>;

  void add(const TimedEdit& edit, const PosedEdit& posed);
  void fix(int vertex, const TimedEdit& edit);
  void add_key(Channel& channel, const TimedEdit& edit, const Key& key, const std::string& what);
  void collect();
  void check_poses(const Channel& channel, const std::string& handle) const;
  Eigen::Vector3d offset(const Channel& channel, FrameTime moment) const;
  Eigen::Vector3d rotation(const Channel& channel, FrameTime moment) const;
  // A matrix of one column for each handle: column(channel).
  template <class Column>
  Eigen::Matrix3Xd columns(Column&& column) const;
  // The same for const and other motions: each channel, vertices before points.
  template <class Self, class Visit>
  static void for_each_channel(Self& self, Visit&& visit);

  Interpolation interpolation_;
  std::function<Eigen::VectorXd(FrameNumber)> weights_;  // of poses, if a cursor blends them
  std::vector<std::string> poses_;                       // where they are
  bool turns_ = false;                                   // an edit rotates
  int groups_ = 0;                                       // of all edits so far
  std::map<int, Channel> vertices_;
  std::map<Point, Channel> points_;
  std::map<int, std::string> fixed_;  // vertices, and the edits that fix them
  Handles handles_;
};

}  // namespace deformlab
