#pragma once

#include <map>
#include <string>
#include <vector>

#include "deformers/deformer.h"
#include "geometry/shape/shape.h"
#include "geometry/transfer/transfer.h"

namespace deformlab {

/// Numbers by their names. Claims are about them, and results list them.
using Metrics = std::map<std::string, double>;

/// The numbers of a report without its seconds: cost and cost.TERM, iterations, converged (1 or 0),
/// nodes, edges, unknowns, factorizations, min_det_R, inside_out, handle_rms, handle_max,
/// length_unit.
Metrics metrics_of(const Report& report);

/// seconds.PHASE of a report; the phases of the solver are seconds.solve.PHASE.
Metrics seconds_of(const Report& report);

/// Measures how `deformed` distorts the triangles and edges of `rest`. With σ1 ≥ σ2 the singular
/// values of a triangle's deformation gradient, these are area-weighted means and maxima over all
/// triangles whose area is not zero:
///   shear    σ1/σ2 − 1, which is 0 where angles are kept
///   stretch  max(σ1, 1/σ2) − 1, which is 0 where lengths are kept
/// and edge_error_mean, the mean of |l/l_rest − 1| over the edges of the triangles. The result is
/// empty for a shape without triangles.
Metrics distortion(const Shape& rest, const Shape& deformed);

/// The same for a part of the surface, as region.shear_mean and so on: the triangles whose corners
/// are all among `vertices`, which ascend. The result is empty if there is no such triangle.
Metrics region_distortion(const Shape& rest, const Shape& deformed,
                          const std::vector<int>& vertices);

/// edge_ratio_max, the greatest ratio of an edge's length to that at rest, and volume, the ratio of
/// the signed volumes, which is left out for a mesh that does not enclose one.
Metrics edge_and_volume_ratios(const Shape& rest, const Shape& deformed);

/// The number of connected components of a shape. A vertex without a face is a component.
int count_components(const Shape& shape);

/// node_shear_max and node_shear_mean: ‖R_j − Q_j‖_F, where Q_j is the orthogonal matrix that is
/// nearest to R_j.
Metrics node_shear(const Transformations& X);

}  // namespace deformlab
