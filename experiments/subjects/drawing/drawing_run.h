#pragma once

#include <filesystem>
#include <string>

#include "experiments/subjects/drawing/drawing_pictures.h"
#include "experiments/subjects/run.h"

namespace deformlab {

/// One run of a config about a drawing, as run_shape is of one about a shape. The metrics are those
/// of any run and of plane_distortion; with a stage of the rigid shape named before them,
/// `intermediate.` (step one alone); overlap_area and interpenetration of depth_metrics.
Run run_drawing(const ExperimentConfig& config, const std::filesystem::path& folder,
                const std::string& caption, bool first, DrawingBook& pictures);

}  // namespace deformlab
