#include "experiments/measure/reference.h"

#include <fmt/format.h>

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
  throw InputError(
      fmt::format("measure.reference ({}) is {}, which {} of {} runs have; name keys of "
                  "the sweep so that one does",
                  filter.where(), to_yaml_line(filter), found.size(), runs.size()));
}

Metrics difference(const Run& run, const Run& reference) {
  if (run.V.cols() == 0 || run.V.cols() != reference.V.cols()) {
    throw InputError(
        fmt::format("measure.reference: a run of {} vertices cannot be compared with one of {}; "
                    "the runs of such "
                    "a sweep must deform one shape or one drawing",
                    run.V.cols(), reference.V.cols()));
  }
  const Eigen::RowVectorXd distances = (run.V - reference.V).colwise().norm() / reference.size;
  return {{"reference_rms", std::sqrt(distances.squaredNorm() / double(distances.size()))},
          {"reference_max", distances.maxCoeff()}};
}

}  // namespace deformlab
