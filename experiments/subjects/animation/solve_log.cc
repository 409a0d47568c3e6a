#include "experiments/subjects/animation/solve_log.h"

#include <algorithm>

namespace deformlab {

void keep_greatest(Metrics& metrics, const Metrics& more) {
  for (const auto& [name, value] : more) {
    double& kept = metrics.try_emplace(name, value).first->second;
    kept = std::max(kept, value);
  }
}

void keep_least(Metrics& metrics, const Metrics& more) {
  for (const auto& [name, value] : more) {
    double& kept = metrics.try_emplace(name, value).first->second;
    kept = std::min(kept, value);
  }
}

namespace {

constexpr std::size_t kMostNotes = 20;  // of a long animation each frame may have another

// Paid once, though each report tells it again; or so short that what else the machine does in one
// frame would be most of a mean.
bool counts_by_the_least(const std::string& phase) {
  return phase == "seconds.sample" || phase == "seconds.embed" || phase == "seconds.connect" ||
         phase == "seconds.transfer";
}

}  // namespace

void SolveLog::add(const Report& report, double size) {
  const Metrics m = metrics_of(report);
  keep_greatest(worst_, {{"iterations", m.at("iterations")},
                         {"handle_rms", m.at("handle_rms")},
                         {"handle_max", m.at("handle_max")},
                         {"handle_rms_relative", report.handle_rms / size},
                         {"inside_out", m.at("inside_out")}});
  keep_least(worst_, {{"converged", m.at("converged")}, {"min_det_R", m.at("min_det_R")}});
  iterations_ += m.at("iterations");
  ++frames_;
  for (const auto& [phase, seconds] : seconds_of(report)) {
    if (counts_by_the_least(phase)) {
      keep_least(least_seconds_, {{phase, seconds}});
    } else {
      seconds_[phase] += seconds;
    }
  }
  for (const std::string& note : report.notes) {
    if (notes_.size() == kMostNotes) break;
    if (std::ranges::find(notes_, note) == notes_.end()) notes_.push_back(note);
  }
  last_ = report;
}

Run SolveLog::run() const {
  Run run;
  if (frames_ == 0) return run;
  run.solve = last_.solve;
  run.notes = notes_;
  run.measured.metrics = worst_;
  run.measured.metrics.merge(metrics_of(last_));
  run.measured.metrics["iterations_mean"] = iterations_ / frames_;
  run.measured.metrics["solves"] = frames_;
  run.seconds = least_seconds_;
  for (const auto& [phase, seconds] : seconds_) run.seconds[phase] = seconds / frames_;
  run.seconds["seconds.update"] = run.seconds.at("seconds.solve");
  return run;
}

}  // namespace deformlab
