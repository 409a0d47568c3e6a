#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/config/override.h"
#include "experiments/subjects/claims.h"
#include "experiments/subjects/experiment.h"
#include "render/image.h"

namespace deformlab {

/// One run of an experiment.
struct Run {
  MeasuredRun measured;
  Metrics seconds;
  Summary solve;
  std::vector<std::string> notes;
  Eigen::Matrix3Xd V{};  ///< where the vertices of a shape or a drawing went, 3×#V
  double size = 1;       ///< diagonal of its bounding box at rest, in the same unit
};

/// All that an experiment gave.
struct Outcome {
  ExperimentConfig config;
  ConfigNode resolved;  ///< the config with every default and override in it
  std::vector<Run> runs;
  std::vector<ClaimResult> claims;
  Image picture;
  std::vector<Image> frames;  ///< of an animation that is to be an image sequence
};

/// Weights are a map, whose keys only the catalog of energies knows: throws InputError for another
/// key below `energies` or `losses` in `root`, and fills in the weights of those that it does
/// not name.
void complete_energies(const ConfigNode& root, EmbeddedDeformationOptions& options);

/// Called before each run, with its number from 1, how many there are, and what it sets.
using Progress = std::function<void(std::size_t, std::size_t, const std::string&)>;

/// Runs the config at `path` with the overrides applied: each combination of its sweep, then the
/// claims, then the picture. Throws InputError for anything in the config that cannot be used.
Outcome run_experiment(const std::filesystem::path& path, const std::vector<Override>& overrides,
                       const Progress& progress);

/// Throws the InputError that run_experiment would throw for the config itself, before any work.
void check_experiment(const std::filesystem::path& path, const std::vector<Override>& overrides);

/// `ceres, nodes 425`: what a run sets, numbers after the last part of their keys; empty for a
/// config without a sweep.
std::string label(const MeasuredRun& run);

}  // namespace deformlab
