#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/config_node.h"
#include "experiments/subjects/animation/frame_pattern.h"
#include "experiments/subjects/motion/interpolation.h"
#include "experiments/subjects/motion/spatial_keys.h"

namespace deformlab {

/// A key pose that is tied to a point of the canvas.
struct SpatialPoseOptions {
  std::vector<double> at;
  ConfigNode edit;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("at", o.at, "The point [x, y] of the canvas at which the pose holds [pixel]");
    visit.required("edit", o.edit, "Selections and what happens to them, as in `edit:`");
  }
};

/// A handle that a recorded performance moves.
struct NamedHandleOptions {
  std::string name;
  std::vector<double> at;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("name", o.name, "What the table of the performance calls the handle");
    visit.required("at", o.at, "The place [x, y] of the drawing that it holds [pixel]");
  }
};

/// What moves a drawing instead of keyframes: a cursor that is recorded among key poses, or handles
/// that are recorded themselves (Igarashi et al. 2005, section 5.3).
struct PerformanceOptions {
  std::vector<SpatialPoseOptions> poses;
  ConfigNode cursor;
  std::vector<NamedHandleOptions> handles;
  ConfigNode performance;

  bool has_cursor() const { return cursor.kind != ConfigNode::Kind::kNull; }
  bool has_performance() const { return performance.kind != ConfigNode::Kind::kNull; }
  bool given() const {
    return !poses.empty() || has_cursor() || !handles.empty() || has_performance();
  }

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("poses", o.poses,
          "Key poses of a drawing that are tied to points of the canvas; a recorded cursor blends "
          "them");
    visit("cursor", o.cursor,
          "The CSV file of the cursor that blends `poses`, beside the YAML file: time,x,y");
    visit("handles", o.handles, "The handles that `performance` moves");
    visit(
        "performance", o.performance,
        "The CSV file of recorded handles of a drawing, beside the YAML file: time,handle,x,y and "
        "perhaps angle");
  }
};

/// A point [x, y] of an option. Throws InputError (naming `what`) for another number of
/// coordinates.
Eigen::Vector2d point_of(const std::vector<double>& at, const std::string& what);

/// A cursor in the order of time.
struct CursorPath {
  std::vector<FrameTime> moments;
  Eigen::Matrix2Xd at;             ///< 2×n [length]
  std::vector<std::string> where;  ///< the line of each
};

/// Reads a table `time,x,y` [s, length]. Throws InputError (naming the line) for what is not in
/// this format, for times that do not ascend, and for less than two rows.
CursorPath read_cursor(const ConfigNode& file, double fps);

/// Key poses, and the cursor that blends them.
struct SpatialScript {
  Eigen::Matrix2Xd points;  ///< of the poses, 2×n [length]
  CursorPath cursor;
};

/// The weights of key poses in each frame of an animation that a cursor performs.
class PerformedPoses {
 public:
  /// `page` is that of the drawing. The canvas is the page with all points of poses. Beyond it,
  /// poses are extrapolated up to half of its width and height, and there the cursor is held.
  PerformedPoses(const SpatialScript& script, const Eigen::AlignedBox2d& page);

  Eigen::VectorXd weights(FrameNumber frame) const;
  /// The pose to whose point the cursor has come in a frame, or nothing between the points.
  std::optional<std::size_t> pose_at(FrameNumber frame) const;
  /// What a user should know: that the cursor leaves the canvas.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  Eigen::Vector2d place(FrameNumber frame) const;

  Eigen::Matrix2Xd points_;
  CursorPath cursor_;
  SpatialKeys keys_;
  std::vector<std::string> notes_;
};

/// One row of a recorded performance.
struct PerformedHandle {
  FrameTime moment = 0;
  Eigen::Vector2d place, target;  ///< at rest, and where it is then [length]
  bool turns = false;
  double degrees = 0;
  std::string where;  ///< "line 7 of 'moves.csv'"
};

/// Reads a table `time,handle,x,y[,angle]` [s, length, degree], in the order of time. Throws
/// InputError (naming the line) for what is not in this format, for a handle without a name in
/// `handles`, and for a handle without a row.
std::vector<PerformedHandle> read_performance(const PerformanceOptions& options, double fps);

}  // namespace deformlab
