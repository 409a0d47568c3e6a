#include "experiments/measure/reference.h"

#include <cmath>

#include "experiments/config/config.h"
#include "geometry/core/error.h"

namespace deformlab {

std::size_t find_reference(const ConfigNode& filter, const std::vector<SweptRun>& runs) {
  check_map(filter, "measure.reference");
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    MeasuredRun run;
    run.settings = runs[i].settings;
    if (matches(run, filter)) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  throw InputError("measure.reference (" + filter.where() + ") is " + to_yaml_line(filter) +
                   ", which " + std::to_string(found.size()) + " of " +
                   std::to_string(runs.size()) +
                   " runs have; name keys of the sweep so that one does");
}

Metrics difference(const Run& run, const Run& reference) {
  if (run.V.cols() == 0 || run.V.cols() != reference.V.cols()) {
    throw InputError("measure.reference: a run of " + std::to_string(run.V.cols()) +
                     " vertices cannot be compared with one of " +
                     std::to_string(reference.V.cols()) +
                     "; the runs of a sweep deform one shape or drawing there");
  }
  const Eigen::RowVectorXd distances = (run.V - reference.V).colwise().norm() / reference.size;
  return {{"reference_rms", std::sqrt(distances.squaredNorm() / double(distances.size()))},
          {"reference_max", distances.maxCoeff()}};
}

}  // namespace deformlab
