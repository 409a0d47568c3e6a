#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/subjects/animation/frame_pattern.h"
#include "experiments/subjects/motion/interpolation.h"
#include "experiments/subjects/motion/performance.h"
#include "experiments/subjects/shape/edit.h"
#include "geometry/core/options.h"

namespace deformlab {

/// A keyframe: one moment and its edit. Exactly one of frame and time is given.
struct KeyframeOptions {
  std::optional<FrameNumber> frame;
  std::optional<double> time;
  ConfigNode edit;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("frame", o.frame, "The number of the frame in which the edit holds");
    visit("time", o.time,
          "Instead of `frame`: the time at which the edit holds, where frame 0 is at time 0 and "
          "`fps` frames follow in each second [s]");
    visit.required("edit", o.edit, "Selections and what happens to them, as in `edit:`");
  }
};

/// The edits of an animation that change with time, in addition to `edit:` itself.
struct KeyframesOptions {
  std::optional<FrameNumber> pose;
  Interpolation interpolation = Interpolation::kLinear;
  double fps = 24;
  int loop = 0;
  std::vector<KeyframeOptions> keyframes;
  PerformanceOptions performed;

  /// Whether something changes with time.
  bool given() const { return !keyframes.empty() || performed.given(); }

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("pose", o.pose,
          "The frame that all selections and positions refer to, and on which the graph is built. "
          "By default `edit` refers to the first frame, and each keyframe to its own");
    visit("interpolation", o.interpolation,
          "How a handle goes from one keyframe to the next: in proportion to time (linear), slowly "
          "at both ends (smooth), or without a jump of its speed and without overshoot (spline)");
    visit.range("fps", o.fps, {.min = 0, .max = 1000, .exclusive_min = true},
                "The number of frames in a second: for `time`, and for an animation in one file");
    visit.range("loop", o.loop, {.min = 0, .max = 65'535},
                "How often an animation in one file is played; 0: for ever");
    visit("keyframes", o.keyframes, "Edits that change with time");
    PerformanceOptions::fields(o.performed, visit);
  }
};

/// One list of edits, and the moment at which it holds.
struct TimedEdit {
  std::optional<FrameTime> frame;  ///< none: the edits hold in all frames
  std::vector<EditEntry> entries;
  std::string where;  ///< "keyframe 2 (line 7 of edit.yaml)", for messages
};

/// "3", or "2.4" for a moment between two frames.
std::string text_of(FrameTime frame);

/// How an animation is edited. `edit:` comes first, then the keyframes in the order of frames.
struct Script {
  std::optional<FrameNumber> pose;
  Interpolation interpolation = Interpolation::kLinear;
  std::vector<TimedEdit> edits;
  /// The weights of poses in a frame: the edits with a moment are then poses, and their moments are
  /// the numbers of the poses, from 0. Otherwise they are keyframes.
  std::function<Eigen::VectorXd(FrameNumber)> weights = {};
};

/// Reads the list under `edit:`: read_edit for shapes, read_plane_edit for drawings.
using EditReader = std::function<std::vector<EditEntry>(const ConfigNode&)>;

/// `edit` may be null if there are keyframes. Throws InputError (naming the line) for anything that
/// is not in the grammar, for two keyframes of one frame, and if nothing is edited.
Script read_script(
    const ConfigNode& edit, const KeyframesOptions& options,
    const EditReader& read = [](const ConfigNode& list) { return read_edit(list); });

/// Puts a YAML file with the keys `edit` and those of KeyframesOptions into the map `root`, as the
/// keys `edit` and `animation` of a config. Throws InputError for another key.
void put_script(const std::filesystem::path& path, ConfigNode& root);

}  // namespace deformlab
