#include "geometry/shape/local_rotations.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <nanoflann.hpp>

namespace deformlab {
namespace {

constexpr std::size_t kNeighbours = 8;  // of a point, besides itself

template <class Visit>
void for_each_edge_of_faces(const Shape& shape, const Visit& visit) {
  for (const auto& face : shape.faces) {
    for (std::size_t c = 0; c < face.size(); ++c) visit(face[c], face[(c + 1) % face.size()]);
  }
}

template <class Visit>
void for_each_edge_of_points(const Eigen::Matrix3Xd& V, const Visit& visit) {
  using Tree =
      nanoflann::KDTreeEigenMatrixAdaptor<Eigen::Matrix3Xd, 3, nanoflann::metric_L2_Simple, false>;
  const Tree tree(3, V);
  const std::size_t most = std::min(kNeighbours + 1, static_cast<std::size_t>(V.cols()));
  std::array<Eigen::Index, kNeighbours + 1> found{};
  std::array<double, kNeighbours + 1> distances{};
  for (Eigen::Index i = 0; i < V.cols(); ++i) {
    const std::size_t count =
        tree.index->knnSearch(V.col(i).data(), most, found.data(), distances.data());
    for (std::size_t k = 0; k < count; ++k) visit(static_cast<int>(i), static_cast<int>(found[k]));
  }
}

/// The rotation that maximises tr(Rᵀ S). Where S leaves an axis free, the smallest rotation of
/// those is taken, for which a small multiple of the identity is added.
Eigen::Matrix3d nearest_rotation(Eigen::Matrix3d S) {
  constexpr double kShare = 1e-9;
  const double size = S.norm();
  if (!(size > 0)) return Eigen::Matrix3d::Identity();
  S.diagonal().array() += kShare * size;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(S, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) *= -1;
  return U * svd.matrixV().transpose();
}

}  // namespace

std::vector<Eigen::Matrix3d> local_rotations(const Shape& rest, const Eigen::Matrix3Xd& V) {
  std::vector<Eigen::Matrix3d> result(static_cast<std::size_t>(V.cols()), Eigen::Matrix3d::Zero());
  const auto add = [&](int a, int b) {
    const Eigen::Matrix3d S = (V.col(b) - V.col(a)) * (rest.V.col(b) - rest.V.col(a)).transpose();
    result[static_cast<std::size_t>(a)] += S;
    result[static_cast<std::size_t>(b)] += S;
  };
  rest.faces.empty() ? for_each_edge_of_points(rest.V, add) : for_each_edge_of_faces(rest, add);
  for (Eigen::Matrix3d& R : result) R = nearest_rotation(R);
  return result;
}

}  // namespace deformlab
