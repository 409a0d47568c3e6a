#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/subjects/shape/edit.h"

namespace deformlab {

/// What an edit of one frame is, among those between which an animation's edit changes.
struct KeyframeOptions {
  int frame = 0;
  ConfigNode edit;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("frame", o.frame, "number of the frame at which it holds");
    visit.required("edit", o.edit, "selections and what happens to them, as in `edit:`");
  }
};

/// When what is edited how, beside `edit:` itself.
struct KeyframesOptions {
  std::optional<int> pose;
  std::string interpolation = "linear";
  std::vector<KeyframeOptions> keyframes;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("pose", o.pose,
          "the frame that all selections and places speak of, and the graph is built on; by "
          "default `edit` means the first frame, and each keyframe its own");
    visit.choice("interpolation", o.interpolation, {"linear", "smooth"},
                 "of the offsets between two keyframes: as it is, or slow at both ends");
    visit("keyframes", o.keyframes, "edits that change with time");
  }
};

/// One list of edits and when it holds.
struct TimedEdit {
  std::optional<int> frame;  ///< none: always
  std::vector<EditEntry> entries;
  std::string where;  ///< "keyframe 2 (line 7 of edit.yaml)", for messages
};

/// How an animation is edited: in the order of `edit:` first, then the keyframes by their frames.
struct Script {
  std::optional<int> pose;
  bool smooth = false;
  std::vector<TimedEdit> edits;
};

/// `edit` may be null where there are keyframes. Throws InputError (naming the line) for anything
/// that is not the grammar, two keyframes of one frame, and where there is nothing at all.
Script read_script(const ConfigNode& edit, const KeyframesOptions& options);

/// Reads a YAML file with the keys `edit` and those of KeyframesOptions.
Script read_script_file(const std::filesystem::path& path);

}  // namespace deformlab
