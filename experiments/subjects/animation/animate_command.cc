#include "experiments/subjects/animation/animate_command.h"

#include <glog/logging.h>

#include <algorithm>
#include <cstdio>

#include "deformers/embedded/animated_deformation.h"
#include "experiments/commands/environment.h"
#include "experiments/commands/results.h"
#include "experiments/config/config.h"
#include "experiments/subjects/animation/animate_options.h"
#include "experiments/subjects/animation/animation_pictures.h"
#include "experiments/subjects/animation/fingerprint.h"
#include "experiments/subjects/animation/frame_log.h"
#include "experiments/subjects/animation/frame_pattern.h"
#include "experiments/subjects/animation/handle_motion.h"
#include "experiments/subjects/animation/progress_line.h"
#include "experiments/subjects/animation/resume_file.h"
#include "experiments/subjects/outputs.h"
#include "experiments/subjects/particles/particle_command.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/shape/shape_io.h"

namespace deformlab {
namespace {

// The input frames, checked before anything is written, and what they were.
class Frames {
 public:
  explicit Frames(const std::string& text)
      : pattern_(text, "--frames"), range_(find_frames(pattern_)) {}

  const FramePattern& pattern() const { return pattern_; }
  const FrameRange& range() const { return range_; }
  Shape read(int frame) const { return read_shape(pattern_.path(frame)); }

  void check(Fingerprint& fingerprint) const {
    const Eigen::Index vertices = read(range_.first).V.cols();
    ProgressLine progress("animate: checked frame");
    for (int frame = range_.first; frame <= range_.last; ++frame) {
      const Eigen::Index found = read(frame).V.cols();
      if (found != vertices) reject(frame, found, vertices);
      fingerprint.add_file(pattern_.path(frame));
      progress.show(frame - range_.first + 1, range_.count());
    }
  }

 private:
  [[noreturn]] void reject(int frame, Eigen::Index found, Eigen::Index vertices) const {
    throw InputError("frame " + std::to_string(frame) + ", '" + pattern_.path(frame).string() +
                     "', has " + std::to_string(found) + " vertices, but frame " +
                     std::to_string(range_.first) + " has " + std::to_string(vertices) +
                     "; all frames of an animation have the same");
  }

  FramePattern pattern_;
  FrameRange range_;
};

// A run: what it is made of, and how far it has come.
struct Sequence {
  const Frames& frames;
  const FramePattern& out;
  const HandleMotion& motion;
  AnimatedDeformation& deformer;
  ResumeFile& resume;
};

bool make_frames(const Sequence& s, FrameLog& log) {
  const FrameRange& range = s.frames.range();
  ProgressLine progress("animate: frame");
  for (int frame = range.first; frame <= range.last; ++frame) {
    if (s.resume.has(frame)) {
      log.pass();
    } else {
      const Shape input = s.frames.read(frame);
      const Report report = s.deformer.update(input, s.motion.offsets(frame));
      if (report.solve.status == Status::kFailed) {
        std::fprintf(stderr, "deformlab: frame %d: the solver failed: %s; it was not written\n",
                     frame, report.solve.message.c_str());
        return false;
      }
      log.add(frame, report, input, s.deformer.deformed());
      write_shape(s.out.path(frame), s.deformer.deformed(), s.frames.pattern().path(frame));
      s.resume.finished(frame);
    }
    progress.show(frame - range.first + 1, range.count());
  }
  return true;
}

// From the files, so that frames that an earlier run has made are in it too.
Image draw(const Sequence& s, const AnimateOptions& options) {
  const FrameRange& range = s.frames.range();
  SeenFrames seen(evenly_spread(range, std::min(options.pictured, range.count())), {});
  for (int frame = range.first; frame <= range.last; ++frame) {
    if (!seen.wants(frame)) continue;
    const Shape input = s.frames.read(frame);
    const Eigen::Matrix3Xd handles =
        input.V(Eigen::all, s.motion.handles().moved) + s.motion.offsets(frame);
    seen.add(frame, {input, read_shape(s.out.path(frame)), handles});
  }
  s.deformer.update(s.frames.read(range.first), s.motion.offsets(range.first));  // for the graph
  AnimationBook book(options.picture);
  book.add(seen, s.deformer.deformation().graph(), "edited");
  return book.sheet();
}

// None of them may be a frame, or the file in which a run that was stopped finds how far it came.
void check_files(const AnimateFlags& flags, const Frames& frames, const FramePattern& out) {
  const int first = frames.range().first;
  check_outputs({frames.pattern().path(first).string(), flags.edit},
                {{out.path(first).string(), "--out"},
                 {out.text() + kProgressEnding, "--out"},
                 {flags.metrics, "--metrics"},
                 {flags.picture, "--picture"}});
  for (const auto& [path, flag] : {std::pair(flags.metrics, "--metrics"),
                                   {flags.picture, "--picture"},
                                   {flags.edit, "--edit"}}) {
    check_no_frame(path, flag, frames.pattern(), "--frames");
    check_no_frame(path, flag, out, "--out");
  }
  check_apart(frames.pattern(), out, frames.range());
}

// Of all that the frames depend on, which are checked on the way.
std::string fingerprint(const AnimateFlags& flags, const AnimateOptions& options,
                        const HandleMotion& motion, const Frames& frames) {
  Fingerprint fingerprint;
  for (const std::string& text :
       {flags.frames, flags.out, motion.description(), to_yaml(to_node(options.deformation)),
        environment().at("commit")}) {
    fingerprint.add(text);
  }
  frames.check(fingerprint);
  return fingerprint.text();
}

int animate_frames(const AnimateFlags& flags, const AnimateOptions& options) {
  if (options.path) throw InputError("'path' is the id of a particle; meshes have none");
  const Script script = read_script_file(flags.edit);
  const FramePattern out(flags.out, "--out");
  const Frames frames(flags.frames);
  check_extension(out.path(0));
  check_files(flags, frames, out);

  const HandleMotion motion(script, frames.range(), [&](int f) { return frames.read(f); });
  const Shape pose = frames.read(script.pose.value_or(frames.range().first));
  AnimatedDeformation deformer(pose, options.deformation);
  deformer.compile(motion.handles());
  ResumeFile resume(out, fingerprint(flags, options, motion, frames));
  if (resume.outdated()) {
    LOG(WARNING) << "a run was stopped before, but its frames or its edit were others: starting "
                    "over";
  }
  const Sequence sequence{frames, out, motion, deformer, resume};
  FrameLog log(bounding_box_diagonal(pose.V), !flags.metrics.empty());
  if (!make_frames(sequence, log)) return 1;
  if (!flags.picture.empty()) write_png(draw(sequence, options), flags.picture);
  if (!flags.metrics.empty()) write_file(flags.metrics, to_json(log.run()));
  resume.remove();
  log.print(flags.out);
  return 0;
}

}  // namespace

int animate_command(const std::vector<std::string>& arguments, const AnimateFlags& flags) {
  if (flags.frames.empty() == flags.particles.empty() || flags.edit.empty() || flags.out.empty()) {
    throw InputError(
        "animate needs frames or particles, an edit and an output: deformlab animate --frames "
        "'horse-%03d.obj' --edit EDIT.yaml --out 'edited-%03d.obj' [key=value]…, or with "
        "--particles cache.csv instead");
  }
  check_picture_name(flags.picture);
  const AnimateOptions options = read_animate_options(arguments, flags);
  return flags.frames.empty() ? animate_particles(flags, options) : animate_frames(flags, options);
}

}  // namespace deformlab
