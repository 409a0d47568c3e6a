#include "experiments/measure/probes.h"

#include <fmt/format.h>

#include "experiments/config/config.h"
#include "experiments/subjects/shape/edit.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

Selection selection(const ConfigNode& region) {
  Selection result;
  read_value(region, "measure.region", result);
  const std::string where = "measure.region (" + region.where() + ")";
  check_selection(result, where);
  read_selection_file(result, region, where);
  return result;
}

}  // namespace

void check(const MeasureOptions& options) {
  if (options.region.kind != ConfigNode::Kind::kNull) selection(options.region);
}

std::vector<int> region_of(const MeasureOptions& options, const Shape& shape) {
  if (options.region.kind == ConfigNode::Kind::kNull) return {};
  return select_vertices(selection(options.region), shape, "measure.region");
}

Eigen::Matrix3Xd read_probes(const ConfigNode& list, int d) {
  if (list.kind == ConfigNode::Kind::kNull) return Eigen::Matrix3Xd(3, 0);
  check_list(list, "measure.probes");
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, std::ssize(list.children));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const ConfigNode& point = list.children[static_cast<std::size_t>(i)];
    const std::string name = fmt::format("measure.probes[{}]", i);
    if (point.kind != ConfigNode::Kind::kList || std::ssize(point.children) != d) {
      throw_wrong_value(point, name, fmt::format("{} coordinates", d));
    }
    for (int c = 0; c < d; ++c) read_value(point.children[c], name, points(c, i));
  }
  return points;
}

Metrics probe_metrics(const Eigen::Matrix3Xd& way, double size) {
  Metrics m;
  for (Eigen::Index i = 0; i < way.cols(); ++i) {
    const std::string name = fmt::format("probe_{}_", i + 1);
    for (int c = 0; c < 3; ++c) m[name + "xyz"[c]] = way(c, i) / size;
  }
  return m;
}

}  // namespace deformlab
