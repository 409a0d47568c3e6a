#pragma once

#include <map>
#include <string>
#include <vector>

#include "deformers/deformer.h"
#include "geometry/shape/shape.h"
#include "geometry/transfer/transfer.h"

namespace deformlab {

/// Numbers by name: what claims are made about and results list.
using Metrics = std::map<std::string, double>;

/// What a report holds, without its seconds: cost and cost.TERM, iterations, converged (1 or 0),
/// nodes, edges, unknowns, factorizations, min_det_R, inside_out, handle_rms, handle_max,
/// length_unit.
Metrics metrics_of(const Report& report);

/// seconds.PHASE of a report; those inside the solver are seconds.solve.PHASE.
Metrics seconds_of(const Report& report);

/// How the triangles and edges of `rest` fare in `deformed`. With σ1 ≥ σ2 the singular values of a
/// triangle's deformation gradient, area-weighted means and maxima over all triangles of area:
///   shear    σ1/σ2 − 1: 0 where angles keep
///   stretch  max(σ1, 1/σ2) − 1: 0 where lengths keep
/// and edge_error_mean, the mean of |l/l_rest − 1| over the triangles' edges. Nothing for a shape
/// without triangles.
Metrics distortion(const Shape& rest, const Shape& deformed);

/// The same of the part of the surface between some vertices (ascending), of the triangles whose
/// corners are all among them, as region.shear_mean and so on. Nothing where there is none.
Metrics region_distortion(const Shape& rest, const Shape& deformed,
                          const std::vector<int>& vertices);

/// How many parts a shape has that no face joins; a vertex without a face is one.
int count_components(const Shape& shape);

/// node_shear_max and node_shear_mean: ‖R_j − Q_j‖_F to the nearest orthogonal matrix Q_j.
Metrics node_shear(const Transformations& X);

}  // namespace deformlab
