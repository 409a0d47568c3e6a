#include "experiments/subjects/particles/particle_subject.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>

#include "experiments/config/override.h"
#include "experiments/scenes/jet.h"
#include "experiments/subjects/animation/animation_pictures.h"
#include "experiments/subjects/animation/progress_line.h"
#include "experiments/subjects/animation/solve_log.h"
#include "experiments/subjects/particles/particle_writer.h"
#include "experiments/subjects/particles/stream_editor.h"
#include "experiments/subjects/particles/stream_measurements.h"
#include "experiments/subjects/run_options.h"

namespace deformlab {
namespace {

constexpr const char* kFlag = "particles";

double node_motion(const StreamDeformation& stream) {
  const Eigen::Matrix3Xd& g = stream.path().V;
  const Transformations X = stream.deformation().transformations();
  double sum = 0;
  for (Eigen::Index j = 0; j < g.cols(); ++j) sum += X.col(4 * j + 3).norm();
  return sum / static_cast<double>(g.cols()) / bounding_box_diagonal(g);
}

// The middle of the jet lies in the plane y = 0. A tint of one side shows how the stream twists.
std::vector<int> left_side(const Eigen::Matrix3Xd& particles) {
  std::vector<int> chosen;
  for (int i = 0; i < particles.cols(); ++i) {
    if (particles(1, i) > 0) chosen.push_back(i);
  }
  return chosen;
}

class ParticleSubject : public Subject {
 public:
  ParticleSubject(const RunOptions& options, const RunContext& context)
      : options_(options), context_(context) {}

  void check() const override { check_animation(options_, context_); }

  void read() override {
    const AnimationOptions& o = options_.animation;
    if (o.file.empty()) {
      particles_ = std::make_unique<Jet>(o.frames, o.bend);
    } else {
      auto cache = std::make_unique<ParticleCache>(context_.folder / o.file);
      if (!cache->streams()) {
        LOG(WARNING) << "the rows are not in order of frames: all are kept at once";
      }
      cache_ = cache.get();
      particles_ = std::move(cache);
    }
    editor_.emplace(*particles_, read_script(options_.edit, o.keyframes),
                    options_.method.deformation, o.path);
    if (context_.writes()) writer_.emplace(*cache_, context_.command->out);
    seen_.emplace(frames_to_see(o, particles_->frames(), context_));
  }

  // A command stops at a frame that cannot be solved; a config measures it.
  void deform() override {
    const FrameRange range = particles_->frames();
    std::optional<ProgressLine> progress;
    if (context_.writes()) progress.emplace("animate: frame");
    bool failed = false;
    particles_->for_each_frame([&](FrameNumber frame, ParticleFrame rows) {
      if (failed) return;
      const Eigen::Matrix3Xd edited = editor_->edited(frame, rows);
      failed = context_.writes() && solve().status == Status::kFailed;
      if (!failed) add(frame, rows, edited);
      if (progress) progress->show(FrameRange{range.first, frame}.count(), range.count());
    });
  }

  const Summary& solve() const override { return editor_->report().solve; }

  Run measure() const override {
    Run run = log_.run();
    Metrics& metrics = run.measured.metrics;
    metrics["handles"] = static_cast<double>(editor_->motion().handles().targets());
    metrics["node_motion"] = node_motion(editor_->stream());
    metrics.merge(measurements_.metrics());
    metrics["vertices"] = metrics.at("particles");
    for (const auto& [phase, seconds] : least_seconds_) run.seconds[phase] = seconds;
    metrics.merge(twist_of(editor_->stream()));
    return run;
  }

  void draw(Book& book, const std::string& caption) override {
    auto& pictures = dynamic_cast<AnimationBook&>(book);
    pictures.look_by(
        camera_for(options_.picture, Eigen::Matrix3Xd(3, 0)));  // a path stands on nothing
    pictures.add(*seen_, editor_->stream().deformation().graph(), caption);
  }

  void write() override { writer_->commit(); }

  std::string summary() const override {
    const ParticleLife& life = editor_->life();
    return fmt::format(
        "{} nodes on the path of particle {}, frames {} to {}\n"
        "handles off by {:.3g} at most; {} rows of {} frames written to {}\n",
        editor_->nodes(), life.id, life.first, life.last, editor_->worst_handle(), cache_->rows(),
        cache_->frames().count(), context_.command->out);
  }

 private:
  void add(FrameNumber frame, ParticleFrame rows, const Eigen::Matrix3Xd& edited) {
    if (writer_) writer_->add(rows, edited);
    if (editor_->solves() > log_.solves()) {
      log_.add(frame, editor_->report(), bounding_box_diagonal(editor_->stream().path().V));
    }
    if (context_.measures()) {
      measurements_.add(editor_->stream(), rows, edited);
      keep_least(least_seconds_, {{"seconds.weights", editor_->seconds().weights},
                                  {"seconds.transfer", editor_->seconds().transfer}});
    }
    if (!seen_->wants(frame)) return;
    const Eigen::Matrix3Xd positions = positions_of(rows);
    seen_->add(frame, {as_points(positions), as_points(edited), editor_->handles(),
                       cache_ ? std::vector<int>{} : left_side(positions)});
  }

  RunOptions options_;
  RunContext context_;
  std::unique_ptr<ParticleSource> particles_;
  const ParticleCache* cache_ = nullptr;  // the source, if it is a file
  std::optional<StreamEditor> editor_;
  std::optional<ParticleWriter> writer_;
  StreamMeasurements measurements_;
  std::optional<SeenFrames> seen_;
  SolveLog log_;
  Metrics least_seconds_;
};

// The terms of the paper do not penalise a twist of the chain of a path, so smoothness is added.
// The chain is solved fastest by this linear solver of Gauss–Newton, which Ceres does not have.
// The graph is a path, where the paper's options do well and those for surfaces have no meaning.
void set_defaults(const CommandLine& line, ConfigNode& root) {
  apply_override(root, {"preset", "sumner_2007", "."});
  apply_override(root, {"energies.smoothness", "1", "."});
  const bool names_method = std::ranges::any_of(
      line.overrides, [](const std::string& text) { return text.starts_with("solver.method="); });
  if (!names_method) apply_override(root, {"solver.linear_solver", "kronecker_cg", "."});
}

}  // namespace

SubjectKind particles_kind() {
  SubjectKind kind = animation_kind();
  kind.name = "particles";
  kind.flag = kFlag;
  kind.is_in = [](const RunOptions& options) {
    const AnimationOptions& o = options.animation;
    return o.generator == AnimationGenerator::kJet ||
           (!o.file.empty() && o.file.find('%') == std::string::npos);
  };
  kind.set_defaults = set_defaults;
  kind.make = [](const RunOptions& options, const RunContext& context) -> std::unique_ptr<Subject> {
    return std::make_unique<ParticleSubject>(options, context);
  };
  return kind;
}

}  // namespace deformlab
