#include "experiments/subjects/animation/animation_options.h"

#include <algorithm>
#include <iterator>

#include "experiments/subjects/animation/resume_file.h"
#include "experiments/subjects/outputs.h"
#include "experiments/subjects/run_options.h"

namespace deformlab {
namespace {

void check_method(const MethodOptions& method) {
  const DeformerKind kind = method.deformer;
  if (kind != DeformerKind::kAuto && kind != DeformerKind::kEmbeddedDeformation) {
    throw OptionError("deformer", std::string(name_of(kind)),
                      ", which takes no animation; embedded_deformation does");
  }
  if (method.adaptive.start != 0) {
    throw OptionError("adaptive.start", std::to_string(method.adaptive.start),
                      ", but the graph of an animation is made once and stays; make it 0");
  }
}

}  // namespace

void check_animation(const RunOptions& options, const RunContext& context) {
  const AnimationOptions& o = options.animation;
  check_method(options.method);
  if (o.generator != AnimationGenerator::kNone && !o.file.empty()) {
    throw OptionError("animation.file", o.file,
                      ", but animation.generator makes an animation too; give one of them");
  }
  if (context.writes()) check_one_sheet(o);
  if (o.file.empty()) {
    check_pictured(o.pictured, std::min(o.frames, kMostPictured), "animation.pictured");
    check(o.sequence, o.frames);
  }
  if (o.keyframes.performed.given()) {
    throw InputError(
        "'poses', 'cursor', 'handles' and 'performance' are for drawings; an animation of a mesh "
        "or of particles takes 'keyframes'");
  }
  read_script(options.edit, o.keyframes);
}

void check_written_frames(const CommandLine& c, const FramePattern& out, const FrameRange& range,
                          std::vector<NamedFile> inputs) {
  const NamedFile progress{out.text() + kProgressEnding, "--out"};
  check_outputs({}, {{out.path(range.first).string(), "--out"}, progress});
  std::vector<NamedFile> written{progress};
  for (FrameNumber i = 0; i < range.count(); ++i) {
    written.push_back({out.path(range.first + i).string(), "--out"});
  }
  std::ranges::move(c.outputs(), std::back_inserter(written));
  inputs.insert(inputs.end(), c.inputs.begin(), c.inputs.end());
  check_distinct(inputs, written);
}

void check_files(const CommandLine& c, const FrameFiles& frames, const FramePattern& out) {
  const FrameRange range = frames.range();
  for (const auto& [path, flag] :
       {std::pair(c.metrics, "--metrics"), {c.picture, "--picture"}, {c.edit, "--edit"}}) {
    check_no_frame(path, flag, frames.pattern());
    check_no_frame(path, flag, out);
  }
  check_apart(frames.pattern(), out, range);
  std::vector<NamedFile> inputs;
  for (FrameNumber i = 0; i < range.count(); ++i) {
    inputs.push_back({frames.pattern().path(range.first + i).string(), "the frame"});
  }
  check_written_frames(c, out, range, std::move(inputs));
}

std::string name_of_file(const RunContext& context, const std::string& flag) {
  return context.writes() ? "--" + flag : "animation.file";
}

void check_one_sheet(const AnimationOptions& o) {
  if (o.sequence.every == 0) return;
  throw OptionError("animation.sequence.every", std::to_string(o.sequence.every),
                    ", but only `run` has a folder for the pictures of a sequence; make it 0");
}

std::vector<FrameNumber> sheet_frames(const AnimationOptions& o, const FrameRange& range,
                                      const RunContext& context) {
  const int count =
      context.draws() ? static_cast<int>(std::min<FrameNumber>(o.pictured, range.count())) : 0;
  return evenly_spread(range, count);
}

SeenFrames frames_to_see(const AnimationOptions& o, const FrameRange& range,
                         const RunContext& context) {
  return {sheet_frames(o, range, context), o.sequence};
}

}  // namespace deformlab
