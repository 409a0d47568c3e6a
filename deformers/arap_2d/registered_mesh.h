#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <complex>
#include <vector>

#include "deformers/arap_2d/triangle_fit.h"
#include "geometry/plane/triangulation.h"
#include "solvers/linear/panel_cholesky.h"

namespace deformlab {

/// What the two steps know of a connected mesh before there are handles (Igarashi et al. 2005,
/// section 4.3, registration). Its vertices stand in a fill-reducing order, their positions are
/// complex numbers x + iy, which halves the size of G: turning by 90° is a factor i.
struct RegisteredMesh {
  /// Throws InputError where the matrices are singular.
  RegisteredMesh(const Triangulation& mesh, const Eigen::VectorXd& weights);

  Eigen::VectorXi vertex;  ///< of the mesh, by place in the order
  Eigen::VectorXi place;   ///< in the order, by vertex of the mesh
  Eigen::VectorXcd p;      ///< at rest, from their mean [length]
  Eigen::Matrix3Xi F;      ///< 3×#F places
  TriangleFit fit;

  /// E = v'ᴴ G v' (Eq. 5) and v''ᴴ H v'' (Eq. 13), lower triangles. G does not see translations,
  /// rotations and scaling, H no translations.
  Eigen::SparseMatrix<std::complex<double>> G;
  Eigen::SparseMatrix<double> H;

  /// Two vertices far from each other: held, they make G regular; the first is enough for H.
  std::array<int, 2> grounded;
  PanelCholesky<std::complex<double>> G_grounded;
  PanelCholesky<double> H_grounded;

 private:
  void put_in_order(const Triangulation& mesh, const Eigen::VectorXd& weights);
  void assemble(const Triangulation& mesh, const Eigen::VectorXd& weights);
  void ground();
};

/// The lower triangle of a matrix whose rows and columns i are replaced by those of the identity
/// wherever held[i].
template <class Scalar>
Eigen::SparseMatrix<Scalar> without(const Eigen::SparseMatrix<Scalar>& lower,
                                    const std::vector<char>& held) {
  Eigen::SparseMatrix<Scalar> result = lower;
  for (int c = 0; c < lower.cols(); ++c) {
    for (typename Eigen::SparseMatrix<Scalar>::InnerIterator it(result, c); it; ++it) {
      if (held[c] || held[it.row()]) it.valueRef() = it.row() == c ? 1 : 0;
    }
  }
  result.prune([](int row, int column, const Scalar& value) {
    return row >= column && (row == column || value != Scalar(0));
  });
  return result;
}

}  // namespace deformlab
