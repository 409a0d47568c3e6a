#pragma once

#include <vector>

#include "experiments/config/config_node.h"
#include "experiments/measure/measurements.h"

namespace deformlab {

/// What is measured beyond what every run measures.
struct MeasureOptions {
  double detail = 0;
  int stripes = 0;
  ConfigNode probes;
  ConfigNode reference;
  ConfigNode region;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("detail", o.detail,
          "surface below this part of the diagonal is detail, and how it survives is measured; "
          "0: it is not");
    visit("stripes", o.stripes,
          "of a generated plane: how striped it is across x, beside the mean of so many columns; "
          "0: it is not measured");
    visit("probes", o.probes, "places at rest whose way is measured: a list of coordinates");
    visit("reference", o.reference,
          "the run of a sweep that each is compared with: dotted keys and their values");
    visit(
        "region", o.region,
        "a selection of vertices of a shape or of an animation's pose: the surface between them is "
        "measured by itself too, as region.…");
  }
};

/// Throws InputError for options out of range, and a region that is no selection.
void check(const MeasureOptions& options);

/// The vertices of the region, ascending; none where no region is measured. Throws InputError where
/// it selects nothing.
std::vector<int> region_of(const MeasureOptions& options, const Shape& shape);

/// The places of a list of coordinates, 3×n; with d = 2 each has two. Throws InputError where it is
/// no such list.
Eigen::Matrix3Xd read_probes(const ConfigNode& list, int d);

/// probe_1_x, probe_1_y, probe_1_z, …: how far each probe went (3×n), in units of `size`.
Metrics probe_metrics(const Eigen::Matrix3Xd& way, double size);

}  // namespace deformlab
