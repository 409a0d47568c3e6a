#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/config_node.h"
#include "experiments/config/override.h"
#include "experiments/subjects/claims.h"
#include "experiments/subjects/run_options.h"
#include "experiments/subjects/subject.h"
#include "render/image.h"

namespace deformlab {

/// The content of a config file: one figure, table or ablation. Its sweep makes a list of runs from
/// the options of one run, and its claims say what they should measure.
struct ExperimentConfig {
  std::string title;
  std::string paper;
  RunOptions run;
  ConfigNode sweep;
  std::vector<Claim> claims;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("title", o.title, "One line for the gallery");
    visit("paper", o.paper, "What the paper says about it");
    RunOptions::fields(o.run, visit);
    visit(
        "sweep", o.sweep,
        "Dotted keys with lists of values, or a word with maps of keys by name; every combination "
        "is run");
    visit("claims", o.claims, "What the measurements must show");
  }
};

/// The results of an experiment.
struct Outcome {
  ExperimentConfig config;
  ConfigNode resolved;  ///< the config with every default and override
  std::vector<Run> runs;
  std::vector<ClaimResult> claims;
  Image picture;
  std::vector<Image> frames;  ///< the image sequence of an animation, if one is asked for
};

/// Called before each run, with its number from 1, the number of runs, and what it sets.
using Progress = std::function<void(std::size_t, std::size_t, const std::string&)>;

/// A config that was read completely: no key is unknown, and no value has a wrong type or is out of
/// range.
struct Plan {
  std::filesystem::path folder;  ///< of the config
  ExperimentConfig config;
  std::vector<SweptRun> combinations;
  std::vector<RunOptions> runs;
  std::vector<ConfigNode> roots;         ///< the config of each run
  std::optional<std::size_t> reference;  ///< the run with which all runs are compared
};

/// Reads the config at `path`, which may be a pipe, once, and applies the overrides. Throws
/// InputError for anything in the config that cannot be used.
Plan plan_experiment(const std::filesystem::path& path, const std::vector<Override>& overrides);

/// Runs each combination of a config's sweep, then checks the claims, then draws the picture.
/// Throws InputError for anything that the runs read and cannot use.
Outcome run_experiment(const Plan& plan, const Progress& progress);

/// `ceres, nodes 425`: what a run sets. The name of a number is the last part of its key. Empty for
/// a config without a sweep.
std::string label(const MeasuredRun& run);

}  // namespace deformlab
