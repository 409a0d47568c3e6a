#include "experiments/measure/detail.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace deformlab {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

constexpr double kNoDetail = 1e-9;  // as a part of the diagonal; less is no detail

// Marks the vertices of edges that have only one triangle.
std::vector<char> on_boundary(const Eigen::Matrix3Xi& T, Eigen::Index count) {
  std::map<std::pair<int, int>, int> triangles;
  for (const auto t : T.colwise()) {
    for (int i = 0; i < 3; ++i) ++triangles[std::minmax({t[i], t[(i + 1) % 3]})];
  }
  std::vector<char> result(count, 0);
  for (const auto& [edge, its] : triangles) {
    if (its == 1) result[edge.first] = result[edge.second] = 1;
  }
  return result;
}

// Computes the smooth base of surfaces that share one triangulation.
class Smoother {
 public:
  Smoother(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T, double length)
      : pinned_(on_boundary(T, V.cols())),
        mass_(Eigen::VectorXd::Constant(V.cols(), 1e-12 * length * length)) {
    for (const auto t : T.colwise()) {
      for (int i = 0; i < 3; ++i) add_corner(V, t[i], t[(i + 1) % 3], t[(i + 2) % 3], length);
    }
    for (int i = 0; i < V.cols(); ++i) {
      if (pinned_[i]) mass_[i] = 1;
      free_.emplace_back(i, i, mass_[i]);
    }
    Matrix A(V.cols(), V.cols());
    A.setFromTriplets(free_.begin(), free_.end());
    solver_.compute(A);
    coupling_.resize(V.cols(), V.cols());
    coupling_.setFromTriplets(to_pinned_.begin(), to_pinned_.end());
  }

  Eigen::Matrix3Xd base(const Eigen::Matrix3Xd& V) const {
    Eigen::MatrixXd b = V.transpose();
    for (int twice = 0; twice < 2; ++twice) {
      b = solver_.solve(mass_.asDiagonal() * b - coupling_ * b).eval();
    }
    return b.transpose();
  }

 private:
  // Adds the cotangent of the angle at c, which is opposite to the edge from a to b.
  void add_corner(const Eigen::Matrix3Xd& V, int a, int b, int c, double length) {
    const Eigen::Vector3d u = V.col(a) - V.col(c), w = V.col(b) - V.col(c);
    const double area = u.cross(w).norm() / 2;
    if (!(area > 0)) return;
    // A negative weight, at an obtuse angle, could turn smoothing into its opposite.
    const double weight = std::max(0.0, length * length * u.dot(w) / (4 * area));
    for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
      if (pinned_[i]) continue;
      free_.emplace_back(i, i, weight);
      (pinned_[j] ? to_pinned_ : free_).emplace_back(i, j, -weight);
    }
    mass_[c] += area / 3;
  }

  std::vector<char> pinned_;
  std::vector<Eigen::Triplet<double>> free_, to_pinned_;
  Eigen::VectorXd mass_;
  Matrix coupling_;
  Eigen::SimplicialLDLT<Matrix> solver_;
};

// For each vertex, another one with which it shares an edge, or -1.
Eigen::VectorXi neighbors(const Eigen::Matrix3Xi& T, Eigen::Index count) {
  Eigen::VectorXi result = Eigen::VectorXi::Constant(count, -1);
  for (const auto t : T.colwise()) {
    for (int i = 0; i < 3; ++i) result[t[i]] = t[(i + 1) % 3];
  }
  return result;
}

// The detail of each vertex in the frame of the base, 3×#V; zero for a vertex without a frame.
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
