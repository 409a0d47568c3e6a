#include "geometry/plane/silhouette.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>
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

// Fills holes in all parts. What lies in a filled hole belongs to the part around it.
void fill_all(const TraceOptions& options, Silhouette& found) {
  std::vector<Region> apart;
  std::size_t filled = fill_holes(options, found.region);
  const std::size_t in_largest = filled;
  for (Region& part : found.detached) {
    filled += fill_holes(options, part);
    const Eigen::Vector2d corner = part.outline.col(0);
    const auto around = [&](const Region& other) { return contains(other, corner); };
    if (in_largest > 0 && around(found.region)) continue;
    if (filled > in_largest && std::ranges::any_of(apart, around)) continue;
    apart.push_back(std::move(part));
  }
  found.detached = std::move(apart);
  found.filled_holes = static_cast<int>(filled);
}

}  // namespace

Silhouette trace(const Eigen::ArrayXXf& alpha, const TraceOptions& options,
                 const std::string& name) {
  check(alpha, options, name);
  std::vector<Region> parts = level_set(alpha, static_cast<float>(options.threshold));
  std::vector<double> areas;
  for (const Region& part : parts) areas.push_back(area(part));
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return areas[i]; });
  const double all = std::reduce(areas.begin(), areas.end());
  Silhouette result{.region = std::move(parts[order.front()])};
  for (const std::size_t i : std::span(order).subspan(1))
    result.detached.push_back(std::move(parts[i]));
  if (!result.detached.empty()) result.detached_share = 1 - areas[order.front()] / all;
  fill_all(options, result);
  return result;
}

}  // namespace deformlab
