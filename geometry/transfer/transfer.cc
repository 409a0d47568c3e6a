#include "geometry/transfer/transfer.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "geometry/core/error.h"
#include "geometry/core/workers.h"
#include "geometry/transfer/blend.h"
#include "geometry/transfer/cofactors.h"

namespace deformlab {
namespace {

// R_j^{-T} of each node, or its cofactor matrix where R_j has no inverse, 3×3m.
Eigen::Matrix3Xd inverse_transposes(const Transformations& X) {
  const Eigen::Index m = X.cols() / 4;
  Eigen::Matrix3Xd result(3, 3 * m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const Eigen::Matrix3d R = X.middleCols<3>(4 * j);
    const double det = R.determinant();
    result.middleCols<3>(3 * j) = cofactors(R) / (std::abs(det) > 1e-12 ? det : 1.0);
  }
  return result;
}

// X has m transformations, and the embedding has n points.
void check_sizes(const Transformations& X, Eigen::Index m, const Embedding& e, Eigen::Index n) {
  const bool fits = X.cols() == 4 * m && e.nodes.cols() == n && e.weights.cols() == n &&
                    e.weights.rows() == e.nodes.rows();
  if (fits) return;
  throw InputError(fmt::format(
      "{} columns of transformations, {} nodes, {} points, and {}x{} nodes and {}x{} "
      "weights of their embedding do not fit together: there are four columns for each "
      "node, and one column of nodes and of weights for each point",
      X.cols(), m, n, e.nodes.rows(), e.nodes.cols(), e.weights.rows(), e.weights.cols()));
}

using Numbers = Eigen::Map<Eigen::Matrix4d>;

Blend blended(const std::vector<Columns>& M, const Embedding& e, const Eigen::Matrix3Xd& v) {
  return {M.data(), e.nodes.data(), e.weights.data(), e.nodes.rows(), v.data(), v.cols()};
}

}  // namespace

Transformations rest_transformations(Eigen::Index m) {
  return Eigen::Matrix<double, 3, 4>::Identity().replicate(1, m);
}

Eigen::Matrix3Xd transfer_positions(const Transformations& X, const Eigen::Matrix3Xd& g,
                                    const Embedding& e) {
  Eigen::Matrix3Xd result;
  transfer_positions(X, g, e, result);
  return result;
}

void transfer_positions(const Transformations& X, const Eigen::Matrix3Xd& g, const Embedding& e,
                        Eigen::Matrix3Xd& result, int threads) {
  check_sizes(X, g.cols(), e, e.v.cols());
  // R_j (v − g_j) + g_j + t_j = R_j v + s_j needs one offset per node, no subtraction per vertex.
  std::vector<Columns> M(g.cols());
  for (Eigen::Index j = 0; j < g.cols(); ++j) {
    Numbers numbers(M[j].numbers);
    numbers.topLeftCorner<3, 3>() = X.middleCols<3>(4 * j);
    numbers.topRightCorner<3, 1>() =
        g.col(j) + X.col(4 * j + 3) - X.middleCols<3>(4 * j) * g.col(j);
  }
  result.resize(3, e.v.cols());
  for_chunks(e.v.cols(), threads, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    blend_points(blended(M, e, e.v), begin, end, result.data());
  });
}

Eigen::Matrix3Xd transfer_normals(const Transformations& X, const Eigen::Matrix3Xd& N,
                                  const Embedding& e) {
  Eigen::Matrix3Xd result;
  transfer_normals(X, N, e, result);
  return result;
}

void transfer_normals(const Transformations& X, const Eigen::Matrix3Xd& N, const Embedding& e,
                      Eigen::Matrix3Xd& result, int threads) {
  check_sizes(X, X.cols() / 4, e, N.cols());
  const Eigen::Matrix3Xd C = inverse_transposes(X);
  std::vector<Columns> M(X.cols() / 4);
  for (Eigen::Index j = 0; j < X.cols() / 4; ++j) {
    Numbers(M[j].numbers).topLeftCorner<3, 3>() = C.middleCols<3>(3 * j);
  }
  result.resize(3, N.cols());
  for_chunks(N.cols(), threads, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    blend_directions(blended(M, e, N), begin, end, result.data());
  });
}

}  // namespace deformlab
