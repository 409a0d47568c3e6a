#include "experiments/subjects/subject.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>

#include "experiments/subjects/animation/mesh_subject.h"
#include "experiments/subjects/drawing/animated_drawing.h"
#include "experiments/subjects/drawing/drawing_subject.h"
#include "experiments/subjects/particles/particle_subject.h"
#include "experiments/subjects/shape/shape_subject.h"
#include "geometry/core/error.h"

namespace deformlab {

const std::vector<SubjectKind>& subject_kinds() {
  static const std::vector<SubjectKind> kinds{
      shape_kind(),          drawing_kind(),   animated_drawing_kind(),
      mesh_animation_kind(), particles_kind(),
  };
  return kinds;
}

// The first kind accepts everything that no other does, so it is tried last.
const SubjectKind& kind_of(const RunOptions& options) {
  const std::vector<SubjectKind>& kinds = subject_kinds();
  const auto kind = std::find_if(kinds.rbegin(), kinds.rend(),
                                 [&](const SubjectKind& one) { return one.is_in(options); });
  return kind == kinds.rend() ? kinds.front() : *kind;
}

const SubjectKind& kind_of(const CommandLine& line, std::string_view flag) {
  const std::vector<SubjectKind>& kinds = subject_kinds();
  const auto kind = std::find_if(kinds.rbegin(), kinds.rend(), [&](const SubjectKind& one) {
    return flag == one.flag && (!flag.empty() || one.reads(line));
  });
  if (kind == kinds.rend()) {
    throw InputError(fmt::format("no kind of subject is read by --{}", flag));
  }
  return *kind;
}

std::string Subject::failure() const {
  if (solve().status != Status::kFailed) return "";
  return fmt::format("the solver failed: {}; nothing was written", solve().message);
}

void log_notes(const Report& report, const RunContext& context) {
  for (const std::string& note : report.notes) LOG(WARNING) << note;
  const Status status = report.solve.status;
  if (!context.writes() || status == Status::kConverged || status == Status::kFailed) return;
  LOG(WARNING) << report.solve.message;
}

Run run_of(const DragReport& drag, const ResolvedEdit& edit, const Eigen::Matrix3Xd& V,
           double size) {
  Run run;
  run.V = V;
  run.size = size;
  run.solve = drag.last.solve;
  run.notes = drag.last.notes;
  run.seconds = seconds_of(drag.last);
  run.seconds.insert(drag.seconds.begin(), drag.seconds.end());
  Metrics& metrics = run.measured.metrics;
  metrics = metrics_of(drag.last);
  metrics.insert(drag.metrics.begin(), drag.metrics.end());
  metrics["vertices"] = static_cast<double>(V.cols());
  metrics["handles"] = static_cast<double>(edit.handles.targets());
  metrics["handle_rms_relative"] = size > 0 ? drag.last.handle_rms / size : 0;
  return run;
}

}  // namespace deformlab
