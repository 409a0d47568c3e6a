#pragma once

#include <Eigen/Core>

#include "geometry/graph/deformation_graph.h"
#include "geometry/transfer/embedding.h"

namespace deformlab {

/// The affine transformations of m nodes, 3×4m: columns 4j … 4j+3 are R_j and t_j (Eq. 1).
using Transformations = Eigen::Matrix3Xd;

/// The transformations of m nodes at rest: R_j = I, t_j = 0.
Transformations rest_transformations(Eigen::Index m);

/// Sumner et al. 2007, Eq. 2: ṽ_i = Σ_j w_j(v_i) [R_j (v_i − g_j) + g_j + t_j].
///   X  3×4m, g  3×m [length]. Returns 3×n positions [length].
/// Throws InputError where sizes do not fit together. The nodes that the embedding names are not
/// checked, because that would take a third of the time; `check` does it.
Eigen::Matrix3Xd transfer_positions(const Transformations& X, const Eigen::Matrix3Xd& g,
                                    const Embedding& embedding);

/// Writes the same into `result`, which keeps its memory if it is 3×n already. The result does not
/// depend on the number of threads.
void transfer_positions(const Transformations& X, const Eigen::Matrix3Xd& g,
                        const Embedding& embedding, Eigen::Matrix3Xd& result, int threads = 1);

/// Eq. 3: ñ_i = Σ_j w_j(v_i) R_j^{-T} n_i, renormalised. Where R_j has no inverse, its cofactor
/// matrix det(R_j) R_j^{-T} is used, which always exists.
///   N  3×n unit normals. Returns 3×n unit normals; a normal that vanishes stays as it was.
Eigen::Matrix3Xd transfer_normals(const Transformations& X, const Eigen::Matrix3Xd& N,
                                  const Embedding& embedding);
void transfer_normals(const Transformations& X, const Eigen::Matrix3Xd& N,
                      const Embedding& embedding, Eigen::Matrix3Xd& result, int threads = 1);

}  // namespace deformlab
