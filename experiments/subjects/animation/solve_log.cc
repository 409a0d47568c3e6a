#include "experiments/subjects/animation/solve_log.h"

#include <glog/logging.h>

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

constexpr std::size_t kMostNotes = 20;  // because each frame of an animation may have others

// Registration is done once, and each report repeats its seconds. A transfer is so short that other
// work of the machine would dominate a mean.
bool counts_by_the_least(const std::string& phase) {
  return phase == "seconds.sample" || phase == "seconds.embed" || phase == "seconds.connect" ||
         phase == "seconds.transfer";
}

}  // namespace

void SolveLog::add(FrameNumber frame, const Report& report, double size) {
  warn(frame, report);
  const Metrics m = metrics_of(report);
  keep_greatest(worst_, {{"iterations", m.at("iterations")},
                         {"handle_rms", m.at("handle_rms")},
                         {"handle_max", m.at("handle_max")},
                         {"handle_rms_relative", report.handle_rms / size},
                         {"inside_out", m.at("inside_out")}});
  keep_least(worst_, {{"converged", m.at("converged")}, {"min_det_R", m.at("min_det_R")}});
  iterations_ += m.at("iterations");
  ++solves_;
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

void SolveLog::warn(FrameNumber frame, const Report& report) {
  std::vector<std::string> notes = report.notes;
  if (report.solve.status == Status::kMaxIterations) notes.push_back(report.solve.message);
  for (const std::string& note : notes) {
    if (std::ranges::find(notes_of_last_, note) != notes_of_last_.end()) continue;
    LOG(WARNING) << "from frame " << frame << ": " << note;
  }
  notes_of_last_ = std::move(notes);
}

Run SolveLog::run() const {
  Run run;
  run.many_solves = true;
  if (solves_ == 0) return run;
  run.solve = last_.solve;
  run.notes = notes_;
  run.measured.metrics = worst_;
  run.measured.metrics.merge(metrics_of(last_));
  run.measured.metrics["iterations_mean"] = iterations_ / solves_;
  run.measured.metrics["solves"] = solves_;
  run.seconds = least_seconds_;
  for (const auto& [phase, seconds] : seconds_) run.seconds[phase] = seconds / solves_;
  run.seconds["seconds.update"] = run.seconds.at("seconds.solve");
  return run;
}

}  // namespace deformlab
