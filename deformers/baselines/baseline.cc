#include "deformers/baselines/baseline.h"

#include <utility>

#include "deformers/handle_checks.h"
#include "solvers/stopwatch.h"

namespace deformlab {

Baseline::Baseline(Shape rest) : rest_(std::move(rest)), deformed_(rest_) {}

void Baseline::check_supported(const Handles& /*handles*/) const {}

void Baseline::compile(const Handles& handles) {
  check_handles(handles, rest_.V.cols());
  refuse_weights(handles);
  check_supported(handles);
  seconds_["compile"] = 0;
  Stopwatch watch(seconds_["compile"]);
  handles_ = handles;
  compilation_notes_.clear();
  compile_handles();
}

Report Baseline::update(const Eigen::Matrix3Xd& targets) {
  check_targets(targets, handles_.targets());
  Report report;
  solve(targets, report);
  report.seconds.insert(seconds_.begin(), seconds_.end());
  report.seconds["solve"] = report.solve.seconds["total"];
  report.notes = registration_notes_;
  report.notes.insert(report.notes.end(), compilation_notes_.begin(), compilation_notes_.end());
  return report;
}

}  // namespace deformlab
