#include "experiments/subjects/drawing/plane_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/subjects/drawing/plane_edit.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr FrameNumber kMostFrames = 100'000;

// The moment of a keyframe, as the file gives it.
std::string moment_text(const KeyframeOptions& o) {
  return o.frame ? fmt::format("frame {}", *o.frame) : fmt::format("time {:g}", o.time.value_or(0));
}

void check_order(const KeyframesOptions& options) {
  const auto moment = [&](const KeyframeOptions& o) {
    return o.frame ? static_cast<FrameTime>(*o.frame)
                   : static_cast<FrameTime>(o.time.value_or(0)) * options.fps;
  };
  for (std::size_t i = 1; i < options.keyframes.size(); ++i) {
    const KeyframeOptions &before = options.keyframes[i - 1], &here = options.keyframes[i];
    if (moment(here) > moment(before)) continue;
    throw InputError(fmt::format(
        "keyframe {} ({}) is of {}, and keyframe {} before it is of {}; keyframes stand in the "
        "order of time, each at a moment of its own",
        i + 1, here.edit.key_where(), moment_text(here), i, moment_text(before)));
  }
}

void check_options_of_meshes(const AnimationOptions& o) {
  if (o.keyframes.pose) {
    throw InputError("'pose' is for meshes: a drawing has one shape at rest; leave it out");
  }
  if (o.path) throw InputError("'path' is the id of a particle; a drawing has none");
  if (o.generator == AnimationGenerator::kNone && o.file.empty()) return;
  throw InputError(
      "a config is about a drawing (drawing.file) or an animation of a mesh or of particles "
      "(animation.file, animation.generator); keep one of them");
}

}  // namespace

Script read_plane_script(const ConfigNode& edit, const AnimationOptions& options) {
  check_options_of_meshes(options);
  Script script = read_script(edit, options.keyframes, read_plane_edit);
  check_order(options.keyframes);
  if (options.keyframes.keyframes.size() < 2) {
    throw InputError(fmt::format(
        "an animation of a drawing goes from one keyframe to the next, so that 'keyframes' needs "
        "two or more entries, and it has {}",
        options.keyframes.keyframes.size()));
  }
  std::vector<std::vector<EditEntry>*> lists;
  for (TimedEdit& timed : script.edits) lists.push_back(&timed.entries);
  complete_angles(lists);
  return script;
}

std::vector<EditEntry> all_entries(const Script& script) {
  std::vector<EditEntry> entries;
  for (const TimedEdit& timed : script.edits) {
    entries.insert(entries.end(), timed.entries.begin(), timed.entries.end());
  }
  return entries;
}

FrameRange frames_of(const Script& script) {
  const auto first = std::ranges::find_if(
      script.edits, [](const TimedEdit& timed) { return timed.frame.has_value(); });
  const TimedEdit& last = script.edits.back();
  if (*first->frame < 0) {
    throw InputError(fmt::format("{} is of frame {}; the frames of a drawing are counted from 0",
                                 first->where, text_of(*first->frame)));
  }
  if (*last.frame - *first->frame > kMostFrames) {
    throw InputError(fmt::format("{} is of frame {}, which is more than {} frames after {}",
                                 last.where, text_of(*last.frame), kMostFrames, first->where));
  }
  const FrameRange range{static_cast<FrameNumber>(std::ceil(*first->frame)),
                         static_cast<FrameNumber>(std::floor(*last.frame))};
  if (range.first <= range.last) return range;
  throw InputError(fmt::format(
      "no frame lies between {} and {}, which are of frames {} and {}; raise 'fps' or move one of "
      "them",
      first->where, last.where, text_of(*first->frame), text_of(*last.frame)));
}

}  // namespace deformlab
