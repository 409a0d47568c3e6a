#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/subjects/animation/frame_pattern.h"
#include "experiments/subjects/shape/edit.h"
#include "geometry/core/options.h"

namespace deformlab {

/// A keyframe: one frame and its edit.
struct KeyframeOptions {
  FrameNumber frame = 0;
  ConfigNode edit;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("frame", o.frame, "The number of the frame in which the edit holds");
    visit.required("edit", o.edit, "Selections and what happens to them, as in `edit:`");
  }
};

/// How offsets change from one keyframe to the next: in proportion to time, or slowly at both ends.
enum class Interpolation { kLinear, kSmooth };
constexpr auto names_of(Interpolation) {
  using enum Interpolation;
  return std::to_array<EnumName<Interpolation>>({{kLinear, "linear"}, {kSmooth, "smooth"}});
}

/// The edits of an animation that change with time, in addition to `edit:` itself.
struct KeyframesOptions {
  std::optional<FrameNumber> pose;
  Interpolation interpolation = Interpolation::kLinear;
  std::vector<KeyframeOptions> keyframes;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("pose", o.pose,
          "The frame that all selections and positions refer to, and on which the graph is built. "
          "By default `edit` refers to the first frame, and each keyframe to its own");
    visit("interpolation", o.interpolation,
          "How offsets go from one keyframe to the next: in proportion to time, or slowly at both "
          "ends");
    visit("keyframes", o.keyframes, "Edits that change with time");
  }
};

/// One list of edits, and the frame in which it holds.
struct TimedEdit {
  std::optional<FrameNumber> frame;  ///< none: the edits hold in all frames
  std::vector<EditEntry> entries;
  std::string where;  ///< "keyframe 2 (line 7 of edit.yaml)", for messages
};

/// How an animation is edited. `edit:` comes first, then the keyframes in the order of frames.
struct Script {
  std::optional<FrameNumber> pose;
  bool smooth = false;
  std::vector<TimedEdit> edits;
};

/// `edit` may be null if there are keyframes. Throws InputError (naming the line) for anything that
/// is not in the grammar, for two keyframes of one frame, and if nothing is edited.
Script read_script(const ConfigNode& edit, const KeyframesOptions& options);

/// Puts a YAML file with the keys `edit` and those of KeyframesOptions into the map `root`, as the
/// keys `edit` and `animation` of a config. Throws InputError for another key.
void put_script(const std::filesystem::path& path, ConfigNode& root);

}  // namespace deformlab
