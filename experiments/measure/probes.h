#pragma once

#include <vector>

#include "experiments/config/config_node.h"
#include "experiments/measure/measurements.h"

namespace deformlab {

/// Measurements in addition to those of every run.
struct MeasureOptions {
  bool edit = false;
  double detail = 0;
  int stripes = 0;
  ConfigNode probes;
  ConfigNode reference;
  ConfigNode region;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("edit", o.edit,
          "Whether to measure how well the edit of a shape is done: handle_miss, the greatest miss "
          "of a handle divided by the longest way of one; edge_ratio_max, the greatest ratio of an "
          "edge's length to that at rest; and, for a closed mesh, volume, the ratio of its volume");
    visit.range("detail", o.detail, {.min = 0, .max = 1},
                "Features of the surface below this share of the bounding box's diagonal count as "
                "detail, and how well they survive is measured; 0 does not measure it");
    visit.range("stripes", o.stripes, {.min = 0},
                "For a generated plane: how striped it is across x, compared with the mean of this "
                "odd number of columns; 0 does not measure it");
    visit("probes", o.probes,
          "Points at rest whose displacement is measured: a list of coordinates");
    visit("reference", o.reference,
          "The run of a sweep with which each run is compared: a map of dotted keys to their "
          "values");
    visit("region", o.region,
          "A selection of vertices of a shape or of an animation's pose. The surface between them "
          "is also measured by itself, as region.…");
  }
};

/// Throws InputError for options out of range, and a region that is no selection.
void check(const MeasureOptions& options);

/// The vertices of the region in ascending order; none if no region is measured. Throws InputError
/// if the region selects nothing.
std::vector<int> region_of(const MeasureOptions& options, const Shape& shape);

/// The points of a list, 3×n [length]. Each has d coordinates in the list. With d = 2, the third is
/// 0. Throws InputError if it is not such a list.
Eigen::Matrix3Xd read_probes(const ConfigNode& list, int d);

/// probe_1_x, probe_1_y, probe_1_z, probe_2_x and so on: the vectors by which the probes moved
/// (`way`, 3×n), divided by `size`.
Metrics probe_metrics(const Eigen::Matrix3Xd& way, double size);

}  // namespace deformlab
