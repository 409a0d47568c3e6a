#pragma once

#include <filesystem>
#include <string>

#include "experiments/subjects/run.h"
#include "experiments/subjects/shape/pictures.h"

namespace deformlab {

/// One run of a config about a shape in space. `folder` is the config's own; what the run shows
/// goes to `pictures`, the rest shape with the first run.
Run run_shape(const ExperimentConfig& config, const std::filesystem::path& folder,
              const std::string& caption, bool first, PictureBook& pictures);

}  // namespace deformlab
