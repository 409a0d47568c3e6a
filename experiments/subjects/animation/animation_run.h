#pragma once

#include <string>

#include "experiments/subjects/animation/animation_pictures.h"
#include "experiments/subjects/run.h"

namespace deformlab {

/// One run of a config about an animation, as run_shape is of one about a shape. The metrics are
/// those of any run, of the last frame that was solved, but for converged, min_det_R, inside_out,
/// iterations, handle_rms and handle_max, which are of the worst, iterations_mean and handles.
/// Of meshes also those of MeshMeasurements, of particles those of StreamLog. What is seen of it
/// goes to `pictures`.
Run run_animation(const ExperimentConfig& config, const std::string& caption,
                  AnimationBook& pictures);

}  // namespace deformlab
