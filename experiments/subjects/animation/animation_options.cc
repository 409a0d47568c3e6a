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
  if (context.writes() && o.sequence.every != 0) {
    throw OptionError("animation.sequence.every", std::to_string(o.sequence.every),
                      ", but only `run` has a folder for the pictures of a sequence; make it 0");
  }
  if (o.file.empty()) {
    check_pictured(o.pictured, std::min(o.frames, kMostPictured), "animation.pictured");
    check(o.sequence, o.frames);
  }
  read_script(options.edit, o.keyframes);
}

void check_files(const CommandLine& c, const FrameFiles& frames, const FramePattern& out) {
  const FrameRange range = frames.range();
  const NamedFile progress{out.text() + kProgressEnding, "--out"};
  check_outputs({}, {{out.path(range.first).string(), "--out"}, progress});
  for (const auto& [path, flag] :
       {std::pair(c.metrics, "--metrics"), {c.picture, "--picture"}, {c.edit, "--edit"}}) {
    check_no_frame(path, flag, frames.pattern());
    check_no_frame(path, flag, out);
  }
  check_apart(frames.pattern(), out, range);
  std::vector<NamedFile> inputs = c.inputs, written{progress};
  for (FrameNumber i = 0; i < range.count(); ++i) {
    inputs.push_back({frames.pattern().path(range.first + i).string(), "the frame"});
    written.push_back({out.path(range.first + i).string(), "--out"});
  }
  std::ranges::move(c.outputs(), std::back_inserter(written));
  check_distinct(inputs, written);
}

std::string name_of_file(const RunContext& context, const std::string& flag) {
  return context.writes() ? "--" + flag : "animation.file";
}

SeenFrames frames_to_see(const AnimationOptions& o, const FrameRange& range,
                         const RunContext& context) {
  const int count =
      context.draws() ? static_cast<int>(std::min<FrameNumber>(o.pictured, range.count())) : 0;
  return {evenly_spread(range, count), o.sequence};
}

}  // namespace deformlab
