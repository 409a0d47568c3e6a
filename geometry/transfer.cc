#include "geometry/transfer.h"

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/clones.h"
#include "geometry/four.h"
#include "geometry/workers.h"

namespace deformlab {
namespace {

// det(R) R^{-T}: its columns are the cross products of R's.
Eigen::Matrix3d cofactors(const Eigen::Matrix3d& R) {
  Eigen::Matrix3d C;
  C << R.col(1).cross(R.col(2)), R.col(2).cross(R.col(0)), R.col(0).cross(R.col(1));
  return C;
}

// R^{-T} for each node, 3×3m.
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

// Σ_j w_j (M_j (v, 1)) for the vertices from begin to end, four coordinates at once, the fourth
// being zero; every node's M_j is 4×4. Where they are `directions`, they are made unit, and one
// that vanishes stays as it was.
template <bool directions>
inline __attribute__((always_inline)) void blend(const double* M, const int* nodes,
                                                 const double* weights, std::ptrdiff_t k,
                                                 const double* v, std::ptrdiff_t begin,
                                                 std::ptrdiff_t end, double* result) {
  nodes += k * begin, weights += k * begin, v += 3 * begin, result += 3 * begin;
  for (std::ptrdiff_t i = begin; i < end; ++i, nodes += k, weights += k, v += 3, result += 3) {
    Four sum = {};
    for (std::ptrdiff_t a = 0; a < k; ++a) {
      const double* m = M + 16 * std::ptrdiff_t(nodes[a]);
      Four there = directions ? Four{} : Four(four(m + 12));
      there += v[0] * four(m);
      there += v[1] * four(m + 4);
      there += v[2] * four(m + 8);
      sum += weights[a] * there;
    }
    if (directions) {
      const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
      sum = length > 0 ? sum * (1 / length) : Four{v[0], v[1], v[2], 0};
    }
    result[0] = sum[0], result[1] = sum[1], result[2] = sum[2];
  }
}

DEFORMLAB_CLONES
void blend_points(const double* M, const int* nodes, const double* weights, std::ptrdiff_t k,
                  const double* v, std::ptrdiff_t begin, std::ptrdiff_t end, double* result) {
  blend<false>(M, nodes, weights, k, v, begin, end, result);
}

DEFORMLAB_CLONES
void blend_directions(const double* M, const int* nodes, const double* weights, std::ptrdiff_t k,
                      const double* v, std::ptrdiff_t begin, std::ptrdiff_t end, double* result) {
  blend<true>(M, nodes, weights, k, v, begin, end, result);
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
  // R_j (v − g_j) + g_j + t_j = R_j v + s_j: one offset a node instead of a subtraction a vertex.
  Eigen::Matrix4Xd M = Eigen::Matrix4Xd::Zero(4, 4 * g.cols());
  for (Eigen::Index j = 0; j < g.cols(); ++j) {
    M.block<3, 3>(0, 4 * j) = X.middleCols<3>(4 * j);
    M.block<3, 1>(0, 4 * j + 3) = g.col(j) + X.col(4 * j + 3) - X.middleCols<3>(4 * j) * g.col(j);
  }
  result.resize(3, e.v.cols());
  for_chunks(e.v.cols(), threads, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    blend_points(M.data(), e.nodes.data(), e.weights.data(), e.nodes.rows(), e.v.data(), begin, end,
                 result.data());
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
  const Eigen::Matrix3Xd C = inverse_transposes(X);
  Eigen::Matrix4Xd M = Eigen::Matrix4Xd::Zero(4, 4 * (X.cols() / 4));
  for (Eigen::Index j = 0; j < X.cols() / 4; ++j) {
    M.block<3, 3>(0, 4 * j) = C.middleCols<3>(3 * j);
  }
  result.resize(3, N.cols());
  for_chunks(N.cols(), threads, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    blend_directions(M.data(), e.nodes.data(), e.weights.data(), e.nodes.rows(), N.data(), begin,
                     end, result.data());
  });
}

}  // namespace deformlab
