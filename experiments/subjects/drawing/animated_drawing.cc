#include "experiments/subjects/drawing/animated_drawing.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include "experiments/commands/environment.h"
#include "experiments/config/config.h"
#include "experiments/measure/depth_jumps.h"
#include "experiments/measure/drag.h"
#include "experiments/subjects/animation/fingerprint.h"
#include "experiments/subjects/animation/progress_line.h"
#include "experiments/subjects/animation/solve_log.h"
#include "experiments/subjects/drawing/drawing_frames.h"
#include "experiments/subjects/drawing/plane_script.h"
#include "experiments/subjects/drawing/plane_shortfalls.h"
#include "experiments/subjects/motion/handle_motion.h"

namespace deformlab {
namespace {

/// What a picture shows of one frame.
struct SeenPose {
  Eigen::Matrix2Xd V;
  Eigen::VectorXd depths;
  ResolvedEdit edit;
};

class AnimatedDrawing : public Subject {
 public:
  AnimatedDrawing(const RunOptions& options, const RunContext& context)
      : options_(options), context_(context) {}

  void check() const override {
    read_plane_script(options_.edit, options_.animation);
    check_drawing_options(options_);
    if (options_.output.steps) {
      throw InputError("output.steps is for one drawing; an animation has many; leave it out");
    }
    if (context_.writes()) check_one_sheet(options_.animation);
  }

  void read() override {
    auto [script, spatial, range] = read_plane_script(options_.edit, options_.animation);
    range_ = range;
    RunContext context = context_;
    if (context_.writes()) {
      frames_.emplace(*context_.command, range_);
      context.command->out = frames_->example().string();
    }
    drawing_.emplace(options_, context, all_entries(script));
    if (spatial) follow_cursor(*spatial, script);
    const auto resolve = [&](const std::vector<EditEntry>& entries, FrameNumber) {
      ResolvedEdit edit = drawing_->resolve(entries);
      Eigen::Matrix3Xd rest = targets_at_rest(drawing_->rest(), edit.handles);
      return PosedEdit{std::move(edit), std::move(rest)};
    };
    motion_.emplace(script, range_, resolve);
    rest_ = targets_at_rest(drawing_->rest(), motion_->handles());
    seen_.emplace(sheet_frames(options_.animation, range_, context_), options_.animation.sequence);
  }

  void deform() override {
    pose_all();
    const bool refused = context_.writes() && context_.command->strict && !undone_.empty();
    if (!context_.writes() || failed_ || refused) return;
    const Page& own = drawing_->scene().drawing.page;
    if (!options_.output.page.fixed(drawing_->scene().drawing)) {
      for (const std::string& note : growth(own, page_)) LOG(WARNING) << note;
    }
    drawing_->reset();
    frames_->write(*drawing_, options_, page_, fingerprint(), [&](FrameNumber frame) {
      update(frame);
      drawing_->show();
    });
  }

  const Summary& solve() const override { return report_.solve; }

  std::string failure() const override {
    if (!failed_) return "";
    return fmt::format("frame {}: the solver failed: {}; nothing was written", *failed_,
                       report_.solve.message);
  }

  std::vector<std::string> shortfalls() const override { return undone_; }

  Run measure() const override {
    Run run = log_.run();
    for (const std::vector<std::string>& notes : {notes_, drawing_->scene().drawing.notes}) {
      run.notes.insert(run.notes.begin(), notes.begin(), notes.end());
    }
    Metrics& metrics = run.measured.metrics;
    metrics["handles"] = static_cast<double>(rest_.cols());
    metrics["frames"] = static_cast<double>(range_.count());
    metrics["depth_jumps"] = jumps_.count();
    if (poses_) {
      metrics["poses_met"] = static_cast<double>(met_.size());
      metrics["pose_error"] = pose_error_;
    }
    metrics.insert(greatest_.begin(), greatest_.end());
    return run;
  }

  void draw(Book& book, const std::string& caption) override {
    auto& pictures = dynamic_cast<DrawingBook&>(book);
    for (const auto& [frame, seen] : seen_->all()) {
      const PicturedDrawing pictured = drawing_->pictured(seen.edit);
      if (pictures.empty()) pictures.add_rest(pictured);
      const std::string name = fmt::format("{}, frame {}", caption, frame);
      if (seen_->is_in_sheet(frame)) pictures.add_deformed(pictured, seen.V, seen.depths, name);
      if (!seen_->is_in_sequence(frame)) continue;
      pictures.add_to_sequence(frame, pictured, seen.V, seen.depths,
                               fmt::format("frame {}", frame));
    }
  }

  void write() override { frames_->complete(); }

  std::string summary() const override {
    return fmt::format(
        "{} vertices, {} triangles, {} frames, {} of them made now, handles off by {:.3g} at most; "
        "written to {}\n",
        drawing_->scene().rest.V.cols(), drawing_->scene().rest.F.cols(), range_.count(),
        frames_->made(), log_.run().measured.metrics.at("handle_max"), context_.command->out);
  }

 private:
  void follow_cursor(const SpatialScript& spatial, Script& script) {
    poses_ = std::make_shared<PerformedPoses>(spatial, drawing_->scene().drawing.page);
    notes_ = poses_->notes();
    for (const std::string& note : notes_) LOG(WARNING) << note;
    script.weights = [poses = poses_](FrameNumber frame) { return poses->weights(frame); };
  }

  // Remembers the shape where the cursor is at the point of a pose.
  void meet_pose(FrameNumber frame) {
    const std::optional<std::size_t> pose = poses_->pose_at(frame);
    if (pose) met_.try_emplace(*pose, frame, drawing_->V());
  }

  // Compares these shapes with those of the poses by themselves.
  void measure_poses() {
    const double size = bounding_box_diagonal(drawing_->rest().V);
    for (const auto& [pose, met] : met_) {
      update(met.first);
      drawing_->deformer().update(rest_ + motion_->offsets_of_pose(pose));
      const Eigen::Matrix2Xd V = drawing_->deformer().deformed().V.topRows<2>();
      pose_error_ = std::max(pose_error_, (V - met.second).colwise().norm().maxCoeff() / size);
    }
  }

  // Poses all frames and measures them. Where a command only writes, the order in depth is not
  // needed yet.
  void pose_all() {
    const bool looks = context_.measures() || context_.draws();
    std::optional<ProgressLine> progress;
    if (context_.writes()) progress.emplace("animate: posed frame");
    page_.setEmpty();
    for (FrameNumber i = 0; i < range_.count(); ++i) {
      const FrameNumber frame = range_.first + i;
      update(frame);
      if (context_.writes() && report_.solve.status == Status::kFailed) {
        failed_ = frame;
        return;
      }
      log_.add(frame, report_, bounding_box_diagonal(drawing_->rest().V));
      find_shortfalls(frame);
      if (looks) look(frame);
      if (looks && poses_) meet_pose(frame);
      if (context_.writes()) extend_page();
      if (progress) progress->show(i + 1, range_.count());
    }
    if (looks) measure_poses();
  }

  void update(FrameNumber frame) {
    Handles handles = motion_->handles();
    handles.rotations = motion_->rotations(frame);
    const bool first = frame == range_.first;
    if (first || handles.rotations.cols() > 0) drawing_->deformer().compile(handles);
    edit_ = {std::move(handles), rest_ + motion_->offsets(frame)};
    report_ = drawing_->deformer().update(edit_.targets);
  }

  void find_shortfalls(FrameNumber frame) {
    if (!undone_.empty()) return;  // one frame tells it for all
    const Eigen::Matrix2Xd V = drawing_->deformer().deformed().V.topRows<2>();
    std::vector<std::string> found = missed_handles(drawing_->scene(), V, edit_, report_);
    std::ranges::move(inside_out(drawing_->scene(), V, report_), std::back_inserter(found));
    for (const std::string& what : found)
      undone_.push_back(fmt::format("frame {}: {}", frame, what));
  }

  void look(FrameNumber frame) {
    drawing_->show();
    if (context_.measures()) {
      jumps_.add(drawing_->overlaps(), drawing_->depths());
      keep_greatest(greatest_, drawing_->metrics());
    }
    if (seen_->wants(frame)) seen_->add(frame, {drawing_->V(), drawing_->depths(), edit_});
  }

  void extend_page() {
    const Eigen::Matrix2Xd V = drawing_->deformer().deformed().V.topRows<2>();
    page_.extend(page_of(*drawing_->bound(), V, options_.output));
  }

  // A fingerprint of all that the frames depend on.
  std::string fingerprint() const {
    Fingerprint fingerprint;
    const ConfigNode o = to_node(options_);
    for (const char* key : {"drawing", "paint", "cut", "depth", "output"}) {
      fingerprint.add(to_yaml(*o.find(key)));
    }
    for (const std::string& text :
         {context_.command->out, motion_->description(), to_yaml(to_node(options_.method)),
          environment().at("commit")}) {
      fingerprint.add(text);
    }
    for (const NamedFile& file : context_.command->inputs) fingerprint.add_file(file.path);
    return fingerprint.text();
  }

  RunOptions options_;
  RunContext context_;
  FrameRange range_;
  std::optional<DrawingFrames> frames_;  // where a command writes them
  std::optional<PosedDrawing> drawing_;
  std::optional<HandleMotion> motion_;
  Eigen::Matrix3Xd rest_;                        // the handles with targets [length]
  std::shared_ptr<const PerformedPoses> poses_;  // that a cursor blends, if there is one
  std::map<std::size_t, std::pair<FrameNumber, Eigen::Matrix2Xd>> met_;  // by pose
  double pose_error_ = 0;                                                // [diagonal]
  std::vector<std::string> notes_;
  ResolvedEdit edit_;  // of the last frame that was posed
  Report report_;      // of the last frame that was posed
  Page page_;
  SolveLog log_;
  DepthJumps jumps_;
  Metrics greatest_;
  std::optional<Seen<SeenPose>> seen_;
  std::vector<std::string> undone_;
  std::optional<FrameNumber> failed_;
};

}  // namespace

SubjectKind animated_drawing_kind() {
  SubjectKind kind = animation_kind();
  kind.name = "an animation of a drawing";
  kind.flag = "drawing";
  kind.file_key = "drawing.file";
  kind.meaningless = {"shape", "drag"};
  kind.automatic = DeformerKind::kArap2d;
  kind.is_in = [](const RunOptions& options) {
    return !options.drawing.file.empty() && options.animation.keyframes.given();
  };
  kind.set_defaults = set_drawing_defaults;
  kind.make = [](const RunOptions& options, const RunContext& context) -> std::unique_ptr<Subject> {
    return std::make_unique<AnimatedDrawing>(options, context);
  };
  kind.make_book = make_drawing_book;
  return kind;
}

}  // namespace deformlab
