#include "experiments/animation/animate_command.h"

#include <glog/logging.h>

#include <algorithm>
#include <cstdio>

#include "deformers/animated_deformation.h"
#include "experiments/animation/animate_options.h"
#include "experiments/animation/fingerprint.h"
#include "experiments/animation/frame_pattern.h"
#include "experiments/animation/handle_motion.h"
#include "experiments/animation/particle_command.h"
#include "experiments/animation/progress_line.h"
#include "experiments/animation/resume_file.h"
#include "experiments/config.h"
#include "experiments/environment.h"
#include "experiments/outputs.h"
#include "geometry/error.h"
#include "geometry/shape_io.h"

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

// What is told of all frames together, and of each what was not told of the one before.
class Worst {
 public:
  void add(int frame, const Report& report) {
    steps_ = std::max(steps_, report.solve.iterations.size());
    off_ = std::max(off_, report.handle_max);
    det_ = std::min(det_, report.min_det_R);
    std::vector<std::string> notes = report.notes;
    if (report.solve.status == Status::kMaxIterations) notes.push_back(report.solve.message);
    for (const std::string& note : notes) {
      if (std::ranges::find(notes_, note) != notes_.end()) continue;
      LOG(WARNING) << "from frame " << frame << ": " << note;
    }
    notes_ = std::move(notes);
  }

  void print(int frames, int made, const std::string& out) const {
    if (made > 0) {
      std::printf("at most %zu steps a frame, handles off by %.3g at most, min det R %.3g\n",
                  steps_, off_, det_);
    }
    std::printf("%d frames, %d of them made now; written to %s\n", frames, made, out.c_str());
  }

 private:
  std::size_t steps_ = 0;
  double off_ = 0, det_ = 1;
  std::vector<std::string> notes_;
};

bool make_frames(const Frames& frames, const FramePattern& out, const HandleMotion& motion,
                 AnimatedDeformation& deformer, ResumeFile& resume) {
  Worst worst;
  int made = 0;
  {
    ProgressLine progress("animate: frame");
    for (int frame = frames.range().first; frame <= frames.range().last; ++frame) {
      if (!resume.has(frame)) {
        const Report report = deformer.update(frames.read(frame), motion.offsets(frame));
        if (report.solve.status == Status::kFailed) {
          std::fprintf(stderr, "deformlab: frame %d: the solver failed: %s; it was not written\n",
                       frame, report.solve.message.c_str());
          return false;
        }
        worst.add(frame, report);
        write_shape(out.path(frame), deformer.deformed(), frames.pattern().path(frame));
        resume.finished(frame);
        ++made;
      }
      progress.show(frame - frames.range().first + 1, frames.range().count());
    }
  }
  resume.remove();
  worst.print(frames.range().count(), made, out.text());
  return true;
}

int animate_frames(const AnimateFlags& flags, const AnimateOptions& options) {
  if (options.path) throw InputError("'path' is the id of a particle; meshes have none");
  const Script script = read_script_file(flags.edit);
  const FramePattern out(flags.out, "--out");
  const Frames frames(flags.frames);
  check_extension(out.path(0));
  check_outputs({flags.edit}, {{out.path(frames.range().first).string(), "--out"}});
  check_apart(frames.pattern(), out, frames.range());

  const HandleMotion motion(script, frames.range(), [&](int f) { return frames.read(f); });
  AnimatedDeformation deformer(frames.read(script.pose.value_or(frames.range().first)),
                               options.deformation);
  deformer.compile(motion.handles());
  Fingerprint fingerprint;
  for (const std::string& text : {flags.frames, flags.out, motion.description(),
                                  to_yaml(to_node(options)), environment().at("commit")}) {
    fingerprint.add(text);
  }
  frames.check(fingerprint);
  ResumeFile resume(out, fingerprint.text());
  if (resume.outdated()) {
    LOG(WARNING) << "a run was stopped before, but its frames or its edit were others: starting "
                    "over";
  }
  return make_frames(frames, out, motion, deformer, resume) ? 0 : 1;
}

}  // namespace

int animate_command(const std::vector<std::string>& arguments, const AnimateFlags& flags) {
  if (flags.frames.empty() == flags.particles.empty() || flags.edit.empty() || flags.out.empty()) {
    throw InputError(
        "animate needs frames or particles, an edit and an output: deformlab animate --frames "
        "'horse-%03d.obj' --edit EDIT.yaml --out 'edited-%03d.obj' [key=value]…, or with "
        "--particles cache.csv instead");
  }
  if (!flags.metrics.empty() || !flags.picture.empty()) {
    throw InputError("--metrics and --picture are for deform; animate has neither");
  }
  const AnimateOptions options = read_animate_options(arguments, flags);
  return flags.frames.empty() ? animate_particles(flags, options) : animate_frames(flags, options);
}

}  // namespace deformlab
