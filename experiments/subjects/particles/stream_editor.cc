#include "experiments/subjects/particles/stream_editor.h"

#include <algorithm>

#include "experiments/measure/drag.h"
#include "geometry/core/error.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

void check(const Script& script, const GraphOptions& graph) {
  if (script.pose) throw InputError("'pose' is for meshes: particles are edited along a path");
  // Both distances are those of a preset. Along one path they are the same.
  const bool is_of_a_preset =
      graph.distance == NodeDistance::kEuclidean || graph.distance == NodeDistance::kPathAware;
  if (graph.method != GraphOptions().method || !is_of_a_preset || !graph.file.empty()) {
    throw InputError(
        "graph.method, graph.distance and graph.file are for shapes: the graph of particles is "
        "sampled on the path of one; set path and graph.nodes");
  }
}

// NaN is the same as NaN here.
bool is_same(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return a.cols() == b.cols() &&
         (a.array() == b.array() || (a.array().isNaN() && b.array().isNaN())).all();
}

}  // namespace

StreamEditor::StreamEditor(const ParticleSource& particles, const Script& script,
                           const EmbeddedDeformationOptions& options,
                           std::optional<std::int64_t> path)
    : life_((check(script, options.graph), find_path(particles, path))),
      stream_(sample_path(particles, life_, options.graph.nodes), options),
      motion_(script, particles.frames(), [&](FrameNumber) { return stream_.path(); }) {
  stream_.compile(motion_.handles());
  rest_ = targets_at_rest(stream_.path(), motion_.handles());
}

void StreamEditor::solve(const Eigen::Matrix3Xd& offsets, const Eigen::Matrix3Xd& rotations) {
  stream_.reset();
  if (rotations.cols() > 0) {
    Handles handles = motion_.handles();
    handles.rotations = rotations;
    stream_.compile(handles);
  }
  report_ = stream_.update(rest_ + offsets);
  offsets_ = offsets;
  rotations_ = rotations;
  ++solves_;
  worst_handle_ = std::max(worst_handle_, report_.handle_max);
}

Eigen::Matrix3Xd StreamEditor::edited(FrameNumber frame, ParticleFrame rows) {
  const Eigen::Matrix3Xd offsets = motion_.offsets(frame);
  const Eigen::Matrix3Xd rotations = motion_.rotations(frame);
  const bool is_new = !is_same(offsets, offsets_) || !is_same(rotations, rotations_);
  if (solves_ == 0 || is_new) solve(offsets, rotations);
  seconds_ = {};
  Embedding particles;
  {
    Stopwatch watch(seconds_.weights);
    particles = stream_.influences(positions_of(rows));
  }
  Stopwatch watch(seconds_.transfer);
  return stream_.deformed(particles);
}

}  // namespace deformlab
