#include "experiments/subjects/animation/animation_run.h"

#include <glog/logging.h>

#include "deformers/embedded/animated_deformation.h"
#include "experiments/scenes/gallop.h"
#include "experiments/scenes/jet.h"
#include "experiments/subjects/animation/mesh_measurements.h"
#include "experiments/subjects/animation/solve_log.h"
#include "experiments/subjects/particles/stream_log.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

SeenFrames frames_to_see(const AnimationOptions& o) {
  return {evenly_spread({0, o.frames - 1}, o.pictured), o.sequence};
}

Run run_gallop(const ExperimentConfig& config, const std::string& caption,
               AnimationBook& pictures) {
  const AnimationOptions& o = config.animation;
  const Gallop gallop(o.cell);
  const auto frame_of = [&](int frame) { return gallop.pose(frame / o.cycle); };
  const Script script = read_script(config.edit, o.keyframes);
  const HandleMotion motion(script, {0, o.frames - 1}, frame_of);
  const Shape pose = frame_of(script.pose.value_or(0));
  AnimatedDeformation deformer(pose, config.method.deformation);
  deformer.compile(motion.handles());
  MeshMeasurements measurements(region_of(config.measure, pose));
  SolveLog log;
  SeenFrames seen = frames_to_see(o);
  const double size = bounding_box_diagonal(pose.V);
  for (int frame = 0; frame < o.frames; ++frame) {
    const Shape input = frame_of(frame);
    log.add(deformer.update(input, motion.offsets(frame)), size);
    measurements.add(input, deformer.deformed());
    if (!seen.wants(frame)) continue;
    seen.add(frame, {input, deformer.deformed(),
                     deformer.deformed().V(Eigen::all, motion.handles().moved)});
  }
  deformer.update(pose, motion.offsets(0));  // the graph of the first panel
  pictures.add(seen, deformer.deformation().graph(), caption);
  Run run = log.run();
  run.measured.metrics["vertices"] = static_cast<double>(pose.V.cols());
  run.measured.metrics["handles"] = static_cast<double>(motion.handles().targets());
  run.measured.metrics.merge(measurements.metrics());
  return run;
}

// Of the jet's middle, which lies in the plane y = 0: they show how the stream turns about itself.
std::vector<int> on_the_left(const Eigen::Matrix3Xd& particles) {
  std::vector<int> chosen;
  for (int i = 0; i < particles.cols(); ++i) {
    if (particles(1, i) > 0) chosen.push_back(i);
  }
  return chosen;
}

Run run_jet(const ExperimentConfig& config, const std::string& caption, AnimationBook& pictures) {
  const AnimationOptions& o = config.animation;
  const Jet jet(o.frames, o.bend);
  StreamEditor editor(jet, read_script(config.edit, o.keyframes), config.method.deformation,
                      o.path);
  StreamLog log;
  SeenFrames seen = frames_to_see(o);
  jet.for_each_frame([&](int frame, ParticleFrame rows) {
    const Eigen::Matrix3Xd edited = editor.edited(frame, rows);
    log.add(editor, rows, edited);
    if (seen.wants(frame)) {
      seen.add(frame, {as_points(places_of(rows)), as_points(edited), editor.handles(),
                       on_the_left(places_of(rows))});
    }
  });
  pictures.add(seen, editor.stream().deformation().graph(), caption);
  return log.run(editor);
}

}  // namespace

void check(const AnimationOptions& o, const ConfigNode& edit) {
  check_pictured(o.pictured, std::min(o.frames, kMostPictured), "animation.pictured");
  check(o.sequence, o.frames);
  read_script(edit, o.keyframes);
}

Run run_animation(const ExperimentConfig& config, const std::string& caption,
                  AnimationBook& pictures) {
  const DeformerKind method = config.method.deformer;
  if (method != DeformerKind::kAuto && method != DeformerKind::kEmbeddedDeformation) {
    throw OptionError("deformer", std::string(name_of(method)),
                      ", which takes no animation; embedded_deformation does");
  }
  if (config.method.adaptive.start != 0) {
    throw OptionError("adaptive.start", std::to_string(config.method.adaptive.start),
                      ", but the graph of an animation is made once and stays; make it 0");
  }
  Run run = config.animation.generator == AnimationGenerator::kJet
                ? run_jet(config, caption, pictures)
                : run_gallop(config, caption, pictures);
  for (const std::string& note : run.notes) LOG(WARNING) << note;
  return run;
}

}  // namespace deformlab
