#include "experiments/commands/deform_ending.h"

#include <glog/logging.h>

#include <cstdio>

#include "experiments/commands/results.h"
#include "geometry/core/files.h"

namespace deformlab {

bool has_ended_well(const Report& report) {
  for (const std::string& note : report.notes) LOG(WARNING) << note;
  if (report.solve.status == Status::kFailed) {
    std::fprintf(stderr, "deformlab: the solver failed: %s; nothing was written\n",
                 report.solve.message.c_str());
    return false;
  }
  if (report.solve.status != Status::kConverged) LOG(WARNING) << report.solve.message;
  return true;
}

void write_deformed(const Report& report, const DeformFlags& flags,
                    const std::function<Image()>& draw, const std::function<void()>& write) {
  Image picture;
  if (!flags.picture.empty()) picture = draw();
  write();
  if (!flags.metrics.empty()) write_file(flags.metrics, to_json(report));
  if (!flags.picture.empty()) write_png(picture, flags.picture);
}

}  // namespace deformlab
