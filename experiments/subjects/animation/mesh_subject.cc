#include "experiments/subjects/animation/mesh_subject.h"

#include <fmt/format.h>

#include "deformers/embedded/animated_deformation.h"
#include "experiments/commands/environment.h"
#include "experiments/config/config.h"
#include "experiments/subjects/animation/animation_pictures.h"
#include "experiments/subjects/animation/frame_loop.h"
#include "experiments/subjects/animation/frame_source.h"
#include "experiments/subjects/animation/mesh_measurements.h"
#include "experiments/subjects/animation/solve_log.h"
#include "experiments/subjects/motion/handle_motion.h"
#include "experiments/subjects/run_options.h"
#include "experiments/subjects/shape/paint.h"
#include "geometry/core/error.h"
#include "geometry/shape/shape_io.h"

namespace deformlab {
namespace {

constexpr const char* kFlag = "frames";

void check_frames_format(const std::filesystem::path& pattern) {
  if (is_shape_file(pattern)) return;
  throw InputError(fmt::format(
      "cannot read the frames '{}': the format '{}' is not known; frames are read from .off, .obj, "
      ".ply, .stl and .xyz",
      pattern.string(), pattern.extension().string()));
}

class MeshSubject : public Subject {
 public:
  MeshSubject(const RunOptions& options, const RunContext& context)
      : options_(options), context_(context) {}

  void check() const override {
    check_animation(options_, context_);
    check_shape_paint(options_.paint);
    if (context_.writes() && options_.animation.path) {
      throw InputError("'path' is the id of a particle; meshes have none");
    }
  }

  void read() override {
    const AnimationOptions& o = options_.animation;
    if (context_.writes()) {
      out_.emplace(context_.command->out, "--out");
      check_frames_format(o.file);
      check_extension(out_->path(0));
    }
    if (o.file.empty()) {
      frames_ = generated_frames(o);
    } else {
      auto files = std::make_unique<FrameFiles>((context_.folder / o.file).string(),
                                                name_of_file(context_, kFlag));
      files_ = files.get();
      frames_ = std::move(files);
    }
    if (context_.writes()) check_files(*context_.command, *files_, *out_);
    const Script script = read_script(options_.edit, o.keyframes);
    motion_.emplace(script, range(), [&](FrameNumber frame) { return frames_->read(frame); });
    pose_ = frames_->read(script.pose.value_or(range().first));
    size_ = bounding_box_diagonal(pose_.V);
    options_.method.deformation.stiffness = painted_stiffness(options_.paint, pose_);
    deformer_.emplace(pose_, options_.method.deformation);
    measurements_ = MeshMeasurements(region_of(options_.measure, pose_));
    seen_.emplace(frames_to_see(o, range(), context_));
  }

  void deform() override {
    deformer_->compile(motion_->handles());
    const auto make_it = [&](FrameNumber frame) { return make(frame); };
    if (context_.writes()) {
      loop_.emplace(*out_, fingerprint());
      loop_->run(range(), make_it, [&](FrameNumber frame) { pass(frame); });
      return;
    }
    Fingerprint nobody_needs_it;
    if (files_ != nullptr) files_->check(nobody_needs_it);
    for (FrameNumber i = 0; i < range().count(); ++i) make_it(range().first + i);
  }

  const Summary& solve() const override { return solve_; }

  std::string failure() const override {
    if (!failed_) return "";
    if (context_.command->strict && !undone_.empty()) {
      return fmt::format("{}; it was not written, because of --strict", undone_.front());
    }
    return fmt::format("frame {}: the solver failed: {}; it was not written", *failed_,
                       solve_.message);
  }

  std::vector<std::string> shortfalls() const override { return undone_; }

  Run measure() const override {
    Run run = log_.run();
    Metrics& metrics = run.measured.metrics;
    metrics["vertices"] = static_cast<double>(pose_.V.cols());
    metrics["handles"] = static_cast<double>(motion_->handles().targets());
    metrics.merge(measurements_.metrics());
    if (!context_.writes()) return run;
    const int made = log_.solves(), passed = loop_->passed();
    metrics["solves"] = made;
    metrics["frames"] = made + passed;
    if (passed > 0) {
      run.notes.push_back(
          fmt::format("{} of {} frames were made by an earlier run; what is measured is of the "
                      "other {}",
                      passed, made + passed, made));
    }
    return run;
  }

  void draw(Book& book, const std::string& caption) override {
    auto& pictures = dynamic_cast<AnimationBook&>(book);
    const FrameNumber first = range().first;
    update(frames_->read(first), first);  // the graph of this frame
    pictures.look_by(camera_for(options_.picture, pose_.V));
    pictures.add(*seen_, deformer_->deformation().graph(), caption);
  }

  void write() override { loop_->complete(); }  // each frame was written when it was made

  std::string summary() const override {
    std::string text;
    const int made = log_.solves();
    if (made > 0) {
      const Metrics m = log_.run().measured.metrics;
      text = fmt::format(
          "at most {:.0f} steps a frame, handles off by {:.3g} at most, min det R {:.3g}\n",
          m.at("iterations"), m.at("handle_max"), m.at("min_det_R"));
    }
    return text + fmt::format("{} frames, {} of them made now; written to {}\n",
                              made + loop_->passed(), made, context_.command->out);
  }

 private:
  FrameRange range() const { return frames_->range(); }

  // A fingerprint of all that the frames depend on. It also checks the input frames.
  std::string fingerprint() const {
    Fingerprint fingerprint;
    for (const std::string& text :
         {context_.command->input, context_.command->out, motion_->description(),
          to_yaml(to_node(options_.method.deformation)), to_yaml(options_.paint),
          environment().at("commit")}) {
      fingerprint.add(text);
    }
    files_->check(fingerprint);
    return fingerprint.text();
  }

  Report update(const Shape& input, FrameNumber frame) {
    return deformer_->update(input, motion_->offsets(frame), motion_->rotations(frame));
  }

  // A command stops at a frame that cannot be solved, and with --strict at one that does not show
  // what the edit asks for. A config measures this frame, because its claims may be about it.
  bool make(FrameNumber frame) {
    const Shape input = frames_->read(frame);
    const Report report = update(input, frame);
    solve_ = report.solve;
    if (undone_.empty()) {  // one frame tells it for all
      for (const std::string& what : report.undone) {
        undone_.push_back(fmt::format("frame {}: {}", frame, what));
      }
    }
    const bool strict = context_.writes() && context_.command->strict && !undone_.empty();
    if (strict || (context_.writes() && solve_.status == Status::kFailed)) {
      failed_ = frame;
      return false;
    }
    log_.add(frame, report, size_);
    if (context_.measures()) measurements_.add(input, deformer_->deformed());
    if (context_.writes()) {
      write_shape(out_->path(frame), deformer_->deformed(), files_->pattern().path(frame));
    }
    if (seen_->wants(frame)) see(frame, input);
    return true;
  }

  // Skips a frame that an earlier run has made.
  void pass(FrameNumber frame) {
    measurements_.interrupt();
    if (seen_->wants(frame)) see(frame, frames_->read(frame));
  }

  // Reads a frame that was written, so that the picture is the same after a stop.
  void see(FrameNumber frame, const Shape& input) {
    const Shape output = context_.writes() ? read_shape(out_->path(frame)) : deformer_->deformed();
    const Eigen::Matrix3Xd handles = output.V(Eigen::all, motion_->handles().moved);
    seen_->add(frame, {input, output, handles});
  }

  RunOptions options_;
  RunContext context_;
  std::optional<FramePattern> out_;
  std::unique_ptr<FrameSource> frames_;
  const FrameFiles* files_ = nullptr;  // the source, if it is files
  std::optional<HandleMotion> motion_;
  Shape pose_;
  double size_ = 0;  // diagonal of its bounding box [length]
  std::optional<AnimatedDeformation> deformer_;
  std::optional<FrameLoop> loop_;
  MeshMeasurements measurements_;
  std::optional<SeenFrames> seen_;
  SolveLog log_;
  Summary solve_;
  std::vector<std::string> undone_;  // what the edit asked for in a frame that does not show it
  std::optional<FrameNumber> failed_;
};

}  // namespace

SubjectKind mesh_animation_kind() {
  SubjectKind kind = animation_kind();
  kind.name = "a mesh animation";
  kind.flag = kFlag;
  std::erase(kind.meaningless, "paint");
  kind.is_in = [](const RunOptions& options) {
    const AnimationOptions& o = options.animation;
    return o.generator == AnimationGenerator::kGallop || o.file.find('%') != std::string::npos;
  };
  kind.make = [](const RunOptions& options, const RunContext& context) -> std::unique_ptr<Subject> {
    return std::make_unique<MeshSubject>(options, context);
  };
  return kind;
}

}  // namespace deformlab
