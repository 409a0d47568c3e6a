#include "experiments/animation/animation_run.h"

#include <glog/logging.h>

#include "deformers/animated_deformation.h"
#include "experiments/animation/coherence.h"
#include "experiments/animation/gallop.h"
#include "experiments/animation/jet.h"
#include "experiments/animation/solve_log.h"
#include "experiments/animation/stream_editor.h"
#include "experiments/animation/stream_measurements.h"
#include "experiments/config.h"
#include "geometry/error.h"

namespace deformlab {
namespace {

constexpr int kMostFrames = 10'000, kMostPictured = 64;

Selection watched(const ConfigNode& node) {
  Selection selection;
  read_value(node, "animation.watch", selection);
  check_selection(selection, "animation.watch (" + node.where() + ")");
  return selection;
}

std::vector<int> pictured_frames(const AnimationOptions& o) {
  std::vector<int> frames;
  for (int i = 0; i < o.pictured; ++i) {
    frames.push_back(static_cast<int>(std::int64_t{i} * o.frames / o.pictured));
  }
  return frames;
}

// What of a run goes into the contact sheet, whose rows are filled one after the other.
class Sheet {
 public:
  Sheet(const AnimationOptions& options, bool with_input) : with_input_(with_input) {
    for (const int frame : pictured_frames(options)) frames_.emplace(frame, Panels{});
  }

  bool wants(int frame) const { return frames_.contains(frame); }
  void add(int frame, Shape input, Shape output, const Eigen::Matrix3Xd& handles) {
    frames_[frame] = {std::move(input), std::move(output), handles};
  }

  void show(const DeformationGraph& graph, const std::string& caption, AnimationBook& book) const {
    book.set_columns(static_cast<int>(frames_.size()));
    bool first = true;
    for (const auto& [frame, panels] : frames_) {
      if (!with_input_) break;
      book.add(panels.input, Eigen::Matrix3Xd(3, 0), "frame " + std::to_string(frame));
      if (first) book.add_graph(graph, true);
      first = false;
    }
    for (const auto& [frame, panels] : frames_) {
      book.add(panels.output, panels.handles, caption + ", frame " + std::to_string(frame));
    }
  }

 private:
  struct Panels {
    Shape input, output;
    Eigen::Matrix3Xd handles;
  };
  bool with_input_;
  std::map<int, Panels> frames_;
};

// The measurements that only meshes allow.
class MeshMeasurements {
 public:
  explicit MeshMeasurements(std::vector<int> watched)
      : watched_(std::move(watched)), coherence_of_watched_(watched_) {}

  void add(const Shape& input, const Shape& output) {
    coherence_.add(input.V, output.V);
    keep_greatest(greatest_, distortion(input, output));
    if (watched_.empty()) return;
    coherence_of_watched_.add(input.V, output.V);
    const double turn = turn_between(input.V(Eigen::all, watched_), output.V(Eigen::all, watched_));
    keep_greatest(greatest_, {{"watched.turn_max", turn},
                              {"watched.edge_error", edge_error(input, output.V, watched_)}});
    keep_least(least_, {{"watched.turn_min", turn}});
  }

  Metrics metrics() const {
    Metrics all = coherence_.metrics();
    all.insert(greatest_.begin(), greatest_.end());
    all.insert(least_.begin(), least_.end());
    if (!watched_.empty()) all.merge(coherence_of_watched_.metrics("watched."));
    return all;
  }

 private:
  std::vector<int> watched_;
  Coherence coherence_, coherence_of_watched_;
  Metrics greatest_, least_;
};

Run run_gallop(const ExperimentConfig& config, const std::string& caption, bool first,
               AnimationBook& pictures) {
  const AnimationOptions& o = config.animation;
  const Gallop gallop(o.cell);
  const auto frame_of = [&](int frame) { return gallop.pose(frame / o.cycle); };
  const Script script = read_script(config.edit, o.keyframes);
  const HandleMotion motion(script, {0, o.frames - 1}, frame_of);
  const Shape pose = frame_of(script.pose.value_or(0));
  AnimatedDeformation deformer(pose, config.method.deformation);
  deformer.compile(motion.handles());
  const bool watches = o.watch.kind != ConfigNode::Kind::kNull;
  MeshMeasurements measurements(watches ? select_vertices(watched(o.watch), pose, "animation.watch")
                                        : std::vector<int>());
  SolveLog log;
  Sheet sheet(o, first);
  const double size = bounding_box_diagonal(pose.V);
  for (int frame = 0; frame < o.frames; ++frame) {
    const Shape input = frame_of(frame);
    log.add(deformer.update(input, motion.offsets(frame)), size);
    measurements.add(input, deformer.deformed());
    if (!sheet.wants(frame)) continue;
    sheet.add(frame, input, deformer.deformed(),
              deformer.deformed().V(Eigen::all, motion.handles().moved));
  }
  deformer.update(pose, motion.offsets(0));  // the graph of the first panel
  sheet.show(deformer.deformation().graph(), caption, pictures);
  Run run = log.run();
  run.measured.metrics["vertices"] = static_cast<double>(pose.V.cols());
  run.measured.metrics["handles"] = static_cast<double>(motion.handles().targets());
  run.measured.metrics.merge(measurements.metrics());
  return run;
}

Shape points(const Eigen::Matrix3Xd& places) { return {places, Eigen::Matrix3Xd(3, 0), {}}; }

double node_motion(const StreamDeformation& stream) {
  const Eigen::Matrix3Xd& g = stream.path().V;
  const Transformations X = stream.deformation().transformations();
  double sum = 0;
  for (Eigen::Index j = 0; j < g.cols(); ++j) sum += X.col(4 * j + 3).norm();
  return sum / static_cast<double>(g.cols()) / bounding_box_diagonal(g);
}

Run run_jet(const ExperimentConfig& config, const std::string& caption, bool first,
            AnimationBook& pictures) {
  const AnimationOptions& o = config.animation;
  const Jet jet(o.frames);
  StreamEditor editor(jet, read_script(config.edit, o.keyframes), config.method.deformation,
                      o.path);
  StreamMeasurements measurements;
  SolveLog log;
  Sheet sheet(o, first);
  const double size = bounding_box_diagonal(editor.stream().path().V);
  int solves = 0;
  jet.for_each_frame([&](int frame, ParticleFrame rows) {
    const Eigen::Matrix3Xd edited = editor.edited(frame, rows);
    if (editor.solves() > solves) log.add(editor.report(), size);
    solves = editor.solves();
    measurements.add(editor.stream(), rows, edited);
    if (sheet.wants(frame)) {
      sheet.add(frame, points(places_of(rows)), points(edited), editor.handles());
    }
  });
  sheet.show(editor.stream().deformation().graph(), caption, pictures);
  Run run = log.run();
  run.measured.metrics["handles"] = static_cast<double>(editor.motion().handles().targets());
  run.measured.metrics["node_motion"] = node_motion(editor.stream());
  run.measured.metrics.merge(measurements.metrics());
  return run;
}

}  // namespace

void check(const AnimationOptions& o, const ConfigNode& edit) {
  if (o.frames < 1 || o.frames > kMostFrames) {
    throw InputError("animation.frames is " + std::to_string(o.frames) + "; it is 1 to " +
                     std::to_string(kMostFrames));
  }
  if (o.pictured < 1 || o.pictured > std::min(o.frames, kMostPictured)) {
    throw InputError("animation.pictured is " + std::to_string(o.pictured) + "; it is 1 to " +
                     std::to_string(std::min(o.frames, kMostPictured)) + " of the frames");
  }
  if (!(o.cycle > 0) || !(o.cell >= 0.01 && o.cell <= 0.06)) {
    throw InputError("animation.cycle is " + std::to_string(o.cycle) + " and animation.cell " +
                     std::to_string(o.cell) +
                     "; a cycle has a positive length, a cell 0.01 to 0.06");
  }
  if (o.watch.kind != ConfigNode::Kind::kNull) watched(o.watch);
  read_script(edit, o.keyframes);
}

Run run_animation(const ExperimentConfig& config, const std::string& caption, bool first,
                  AnimationBook& pictures) {
  const std::string& method = config.method.deformer;
  if (method != "auto" && method != "embedded_deformation") {
    throw InputError("deformer '" + method + "' takes no animation; embedded_deformation does");
  }
  Run run = config.animation.generator == "jet" ? run_jet(config, caption, first, pictures)
                                                : run_gallop(config, caption, first, pictures);
  for (const std::string& note : run.notes) LOG(WARNING) << note;
  return run;
}

}  // namespace deformlab
