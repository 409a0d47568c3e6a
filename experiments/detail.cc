#include "experiments/detail.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>
#include <vector>

namespace deformlab {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

constexpr double kNoDetail = 1e-9;  // of the diagonal

// The smooth base of surfaces that share one triangulation.
class Smoother {
 public:
  Smoother(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T, double length)
      : mass_(Eigen::VectorXd::Constant(V.cols(), 1e-12 * length * length)) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto t : T.colwise()) {
      for (int i = 0; i < 3; ++i) {
        const int a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
        const Eigen::Vector3d u = V.col(a) - V.col(c), w = V.col(b) - V.col(c);
        const double area = u.cross(w).norm() / 2;
        if (!(area > 0)) continue;
        // A negative weight, at an obtuse angle, could turn smoothing into its opposite.
        const double weight = std::max(0.0, length * length * u.dot(w) / (4 * area));
        entries.insert(entries.end(),
                       {{a, a, weight}, {b, b, weight}, {a, b, -weight}, {b, a, -weight}});
        mass_[c] += area / 3;
      }
    }
    for (int i = 0; i < V.cols(); ++i) entries.emplace_back(i, i, mass_[i]);
    Matrix A(V.cols(), V.cols());
    A.setFromTriplets(entries.begin(), entries.end());
    solver_.compute(A);
  }

  Eigen::Matrix3Xd base(const Eigen::Matrix3Xd& V) const {
    const Eigen::MatrixXd once = solver_.solve(mass_.asDiagonal() * V.transpose());
    return solver_.solve(mass_.asDiagonal() * once).transpose();
  }

 private:
  Eigen::VectorXd mass_;
  Eigen::SimplicialLDLT<Matrix> solver_;
};

// For each vertex another one that it shares an edge with.
Eigen::VectorXi neighbors(const Eigen::Matrix3Xi& T, Eigen::Index count) {
  Eigen::VectorXi result = Eigen::VectorXi::Constant(count, -1);
  for (const auto t : T.colwise()) {
    for (int i = 0; i < 3; ++i) result[t[i]] = t[(i + 1) % 3];
  }
  return result;
}

// The detail of each vertex in the frame of the base there, 3×#V; zero where there is no frame.
Eigen::Matrix3Xd in_frames(const Eigen::Matrix3Xd& V, const Shape& base,
                           const Eigen::VectorXi& neighbor) {
  const Eigen::Matrix3Xd N = vertex_normals(base);
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, V.cols());
  for (Eigen::Index i = 0; i < V.cols(); ++i) {
    if (neighbor[i] < 0) continue;
    const Eigen::Vector3d n = N.col(i), edge = base.V.col(neighbor[i]) - base.V.col(i);
    const Eigen::Vector3d t = (edge - edge.dot(n) * n).normalized();
    const Eigen::Vector3d d = V.col(i) - base.V.col(i);
    result.col(i) << d.dot(n), d.dot(t), d.dot(n.cross(t));
  }
  return result;
}

}  // namespace

Metrics detail(const Shape& rest, const Shape& deformed, double length) {
  const Eigen::Matrix3Xi T = triangles(rest);
  const double size = bounding_box_diagonal(rest.V);
  if (T.cols() == 0 || size == 0) return {};
  const Smoother smoother(rest.V, T, length * size);
  const Eigen::VectorXi neighbor = neighbors(T, rest.V.cols());
  Shape base = rest;
  base.V = smoother.base(rest.V);
  const Eigen::Matrix3Xd before = in_frames(rest.V, base, neighbor);
  base.V = smoother.base(deformed.V);
  const Eigen::Matrix3Xd after = in_frames(deformed.V, base, neighbor);
  Metrics m{{"detail_rms", std::sqrt(after.squaredNorm() / after.cols()) / size}};
  double weight = 0, turn = 0, error = 0;
  for (Eigen::Index i = 0; i < before.cols(); ++i) {
    const double b = before.col(i).norm(), a = after.col(i).norm();
    if (!(b > kNoDetail * size)) continue;
    const double angle =
        std::atan2(before.col(i).cross(after.col(i)).norm(), before.col(i).dot(after.col(i)));
    weight += b;
    turn += b * angle * 180 / std::numbers::pi;
    error += std::abs(a - b);
  }
  if (weight > 0)
    m.insert({{"detail_turn", turn / weight}, {"detail_length_error", error / weight}});
  return m;
}

}  // namespace deformlab
