#include "experiments/subjects/motion/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/config/config.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

/// The keys of an edit file for animations.
struct ScriptFile {
  ConfigNode edit;
  KeyframesOptions keyframes;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("edit", o.edit, "Selections and what happens to them in all frames");
    KeyframesOptions::fields(o.keyframes, visit);
  }
};

FrameTime moment_of(const KeyframeOptions& o, double fps, const std::string& where) {
  if (o.frame && o.time) {
    throw InputError(fmt::format("{} has both 'frame' and 'time'; keep one of them", where));
  }
  if (o.frame) return static_cast<FrameTime>(*o.frame);
  if (!o.time) {
    throw InputError(fmt::format(
        "missing key 'frame' of {}: give the number of the frame, or 'time' in seconds", where));
  }
  return static_cast<FrameTime>(*o.time) * fps;
}

TimedEdit keyframe(const KeyframeOptions& options, double fps, std::size_t number,
                   const EditReader& read) {
  const std::string where = fmt::format("keyframe {} ({})", number, options.edit.key_where());
  return {moment_of(options, fps, where), read(options.edit), where};
}

void check_distinct(const std::vector<TimedEdit>& edits) {
  for (std::size_t i = 1; i < edits.size(); ++i) {
    if (!edits[i - 1].frame || edits[i - 1].frame != edits[i].frame) continue;
    throw InputError(fmt::format("{} and {} are both of frame {}; make one of them",
                                 edits[i - 1].where, edits[i].where, text_of(*edits[i].frame)));
  }
}

}  // namespace

std::string text_of(FrameTime frame) {
  const bool is_whole = frame == std::floor(frame) && std::abs(frame) < 9e18L;
  if (is_whole) return std::to_string(static_cast<FrameNumber>(frame));
  return fmt::format("{:.6g}", static_cast<double>(frame));
}

Script read_script(const ConfigNode& edit, const KeyframesOptions& options,
                   const EditReader& read) {
  Script script{options.pose, options.interpolation, {}, {}};
  const bool has_edit = edit.kind != ConfigNode::Kind::kNull;
  if (!has_edit && options.keyframes.empty()) {
    throw InputError("nothing is edited: the edit has neither 'edit' nor 'keyframes'");
  }
  if (has_edit) script.edits.push_back({{}, read(edit), "edit (" + edit.key_where() + ")"});
  for (std::size_t i = 0; i < options.keyframes.size(); ++i) {
    script.edits.push_back(keyframe(options.keyframes[i], options.fps, i + 1, read));
  }
  std::stable_sort(script.edits.begin(), script.edits.end(),
                   [](const auto& a, const auto& b) { return a.frame < b.frame; });
  check_distinct(script.edits);
  return script;
}

void put_script(const std::filesystem::path& path, ConfigNode& root) {
  const ConfigNode file = load_config(path);
  read_config<ScriptFile>(file);
  ConfigNode edit, animation;
  edit.key = "edit";
  animation.key = "animation";
  animation.kind = ConfigNode::Kind::kMap;
  for (const ConfigNode& child : file.children) {
    if (child.key == "edit") {
      edit = child;
    } else {
      animation.children.push_back(child);
    }
  }
  root.children.push_back(edit);
  root.children.push_back(animation);
}

}  // namespace deformlab
