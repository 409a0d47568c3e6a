#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <complex>
#include <vector>

#include "deformers/arap_2d/triangle_fit.h"
#include "geometry/plane/triangulation.h"
#include "solvers/linear/panel_cholesky.h"

namespace deformlab {

/// The registration of a connected mesh (Igarashi et al. 2005, section 4.3) computes what the two
/// steps need and what does not depend on handles. Vertices are in a fill-reducing order. Positions
/// are complex numbers x + iy, which halves the size of G: a rotation by 90° is the factor i.
struct RegisteredMesh {
  ///   weights  #F, the stiffness of each triangle (section 5.2)
  /// Throws InputError where the matrices are singular in double precision.
  RegisteredMesh(const Triangulation& mesh, const Eigen::VectorXd& weights);

  Eigen::VectorXi order;  ///< #V: order[i] is the vertex of the mesh that is the i-th here
  Eigen::VectorXi index;  ///< #V, the inverse: order[index[v]] = v
  Eigen::VectorXcd p;     ///< #V positions at rest, relative to their mean [length]
  double extent;          ///< that of p [length]
  Eigen::Matrix3Xi F;     ///< 3×#F triangles, as indices in this order
  TriangleFit fit;        ///< the fitting of these triangles

  /// The quadratic forms v'ᴴ G v' of step one (Eq. 5) and v''ᴴ H v'' of step two (Eq. 13), as lower
  /// triangles. The null space of G contains translations, rotations and scalings, that of H only
  /// translations.
  Eigen::SparseMatrix<std::complex<double>> G;
  Eigen::SparseMatrix<double> H;

  /// Two vertices that are far from each other. G without both of them is regular, and so is H
  /// without the first. These are the grounded matrices, and their factors are stored.
  std::array<int, 2> grounded;
  PanelCholesky<std::complex<double>> G_grounded;
  PanelCholesky<double> H_grounded;

 private:
  void sort_vertices(const Triangulation& mesh, const Eigen::SparseMatrix<double>& structure);
  void assemble(const Eigen::Matrix3Xi& all, const Eigen::VectorXd& weights,
                const Eigen::VectorXd& weak);
  void ground();
};

/// Eliminates the unknowns i with fixed[i] from a symmetric matrix, which is given by its lower
/// triangle: replaces their rows and columns by those of the identity.
template <class Scalar>
Eigen::SparseMatrix<Scalar> eliminated(const Eigen::SparseMatrix<Scalar>& lower,
                                       const std::vector<char>& fixed) {
  Eigen::SparseMatrix<Scalar> result = lower;
  for (int c = 0; c < lower.cols(); ++c) {
    for (typename Eigen::SparseMatrix<Scalar>::InnerIterator it(result, c); it; ++it) {
      if (fixed[c] || fixed[it.row()]) it.valueRef() = it.row() == c ? 1 : 0;
    }
  }
  result.prune([](int row, int column, const Scalar& value) {
    return row >= column && (row == column || value != Scalar(0));
  });
  return result;
}

}  // namespace deformlab
