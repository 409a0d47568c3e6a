#include "geometry/plane/silhouette.h"

#include <algorithm>
#include <numeric>
#include <sstream>

#include "geometry/core/error.h"
#include "geometry/plane/marching_squares.h"

namespace deformlab {
namespace {

void check(const Eigen::ArrayXXf& alpha, const TraceOptions& options, const std::string& name) {
  check_options(options);
  std::ostringstream what;
  if (alpha.size() == 0) {
    what << "it has no pixels";
  } else if (!alpha.allFinite()) {
    what << "its opacity is not finite everywhere";
  } else if (const float most = alpha.maxCoeff(); !(most >= options.threshold)) {
    what << "it has no opaque pixel: the greatest opacity is " << most
         << ", but the shape begins at " << options.threshold << " (threshold)";
  }
  if (!what.str().empty()) throw InputError("cannot trace '" + name + "': " + what.str());
}

std::size_t fill_holes(const TraceOptions& options, Region& region) {
  return std::erase_if(region.holes, [&](const Eigen::Matrix2Xd& hole) {
    return options.fill_holes || -signed_area(hole) < options.least_hole;
  });
}

}  // namespace

Silhouette trace(const Eigen::ArrayXXf& alpha, const TraceOptions& options,
                 const std::string& name) {
  check(alpha, options, name);
  std::vector<Region> parts = level_set(alpha, static_cast<float>(options.threshold));
  std::vector<double> areas(parts.size());
  std::ranges::transform(parts, areas.begin(), [](const Region& part) { return area(part); });
  const auto largest = std::ranges::max_element(areas);
  Silhouette result{.region = std::move(parts[largest - areas.begin()])};
  result.left_out = static_cast<int>(parts.size()) - 1;
  result.left_out_share = 1 - *largest / std::reduce(areas.begin(), areas.end());
  if (result.left_out == 0) result.left_out_share = 0;
  result.filled_holes = static_cast<int>(fill_holes(options, result.region));
  return result;
}

}  // namespace deformlab
