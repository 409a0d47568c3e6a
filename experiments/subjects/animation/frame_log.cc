#include "experiments/subjects/animation/frame_log.h"

#include <glog/logging.h>

#include <algorithm>
#include <cstdio>

namespace deformlab {

void FrameLog::add(int frame, const Report& report, const Shape& input, const Shape& output) {
  warn(frame, report);
  solves_.add(report, size_);
  if (measures_) measurements_.add(input, output);
  ++made_;
}

void FrameLog::warn(int frame, const Report& report) {
  std::vector<std::string> notes = report.notes;
  if (report.solve.status == Status::kMaxIterations) notes.push_back(report.solve.message);
  for (const std::string& note : notes) {
    if (std::ranges::find(notes_, note) != notes_.end()) continue;
    LOG(WARNING) << "from frame " << frame << ": " << note;
  }
  notes_ = std::move(notes);
}

void FrameLog::pass() {
  measurements_.interrupt();
  ++passed_;
}

Run FrameLog::run() const {
  Run run = solves_.run();
  if (measures_) run.measured.metrics.merge(measurements_.metrics());
  run.measured.metrics["solves"] = made_;
  run.measured.metrics["frames"] = made_ + passed_;
  if (passed_ > 0) {
    run.notes.push_back(std::to_string(passed_) + " of " + std::to_string(made_ + passed_) +
                        " frames were made by an earlier run; what is measured is of the other " +
                        std::to_string(made_));
  }
  return run;
}

void FrameLog::print(const std::string& out) const {
  if (made_ > 0) {
    const Metrics m = solves_.run().measured.metrics;
    std::printf("at most %.0f steps a frame, handles off by %.3g at most, min det R %.3g\n",
                m.at("iterations"), m.at("handle_max"), m.at("min_det_R"));
  }
  std::printf("%d frames, %d of them made now; written to %s\n", made_ + passed_, made_,
              out.c_str());
}

}  // namespace deformlab
