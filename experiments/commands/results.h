#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "experiments/subjects/run.h"

namespace deformlab {

/// A folder that appears whole or not at all: what is written goes to a hidden folder beside it,
/// which `commit` puts in its place, an older one of that name with all it holds being replaced
/// only then. Without a commit nothing stays.
class AtomicFolder {
 public:
  /// Throws InputError where the folder cannot be made or written, before any work is done for it.
  explicit AtomicFolder(std::filesystem::path target);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  const std::filesystem::path& path() const { return temporary_; }
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  std::vector<std::filesystem::path> made_;  ///< missing folders on the way, the deepest first
};

/// Writes into `folder`: config.yaml (with every default), metrics.json, environment.json,
/// times.json (all seconds; the other files are the same bytes in every run), a trace of each solve
/// (trace.csv, or trace_001.csv … of a sweep), table.md of a sweep, picture.png, and of an
/// animation that is to be an image sequence frames/0000.png …
void write_results(const Outcome& outcome, const std::filesystem::path& folder);

/// A report as JSON, for `deform --metrics`.
std::string to_json(const Report& report);

/// What was told of an animation as JSON, for `animate --metrics`: its metrics but for costs.
std::string to_json(const Run& run);

/// Rewrites README.md of a results folder from what lies in it: a picture, the claims and the table
/// of each experiment, in order of their names.
void write_gallery(const std::filesystem::path& results);

}  // namespace deformlab
