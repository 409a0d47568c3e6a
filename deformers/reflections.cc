#include "deformers/reflections.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>

namespace deformlab {
namespace {

constexpr int kSweeps = 300;  // that spread rotations

using Neighbors = std::vector<std::vector<int>>;

Neighbors neighbors(const DeformationGraph& graph) {
  Neighbors result(graph.g.cols());
  for (const GraphEdge& e : graph.edges) {
    result[e.j].push_back(e.k);
    result[e.k].push_back(e.j);
  }
  return result;
}

// The direction in which the neighbours of a node extend least.
Eigen::Vector3d normal(const DeformationGraph& graph, const std::vector<int>& around, int j) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const int k : around) {
    const Eigen::Vector3d g_jk = graph.g.col(k) - graph.g.col(j);
    spread += g_jk * g_jk.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
}

// q and −q are the same rotation: each takes the sign that is nearer to the node it is reached
// from.
void align(const Neighbors& around, Eigen::Matrix4Xd& q) {
  std::vector<char> seen(around.size(), 0);
  std::vector<int> queue;
  for (std::size_t seed = 0; seed < around.size(); ++seed) {
    if (seen[seed]) continue;
    seen[seed] = 1;
    queue.assign(1, static_cast<int>(seed));
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const int k : around[queue[i]]) {
        if (seen[k]) continue;
        seen[k] = 1;
        queue.push_back(k);
        if (q.col(k).dot(q.col(queue[i])) < 0) q.col(k) = -q.col(k);
      }
    }
  }
}

// Where the nodes that are not held come to lie when every edge turns as its two nodes do:
// p_k − p_j = ½ (R_j + R_k) g_jk in the sense of least squares.
void place(const DeformationGraph& graph, const std::vector<char>& held, Unknowns& x) {
  const int m = x.nodes();
  std::vector<int> row(m, -1);
  int n = 0;
  for (int j = 0; j < m; ++j) row[j] = held[j] ? -1 : n++;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d b = Eigen::MatrixX3d::Zero(n, 3);
  const auto add = [&](int j, int k, const Eigen::Vector3d& from_k) {
    if (row[j] < 0) return;
    entries.emplace_back(row[j], row[j], 1);
    b.row(row[j]) += from_k;
    if (row[k] < 0) {
      b.row(row[j]) += graph.g.col(k) + x.X.col(x.first[k] + 3);
    } else {
      entries.emplace_back(row[j], row[k], -1);
    }
  };
  for (const auto& [j, k, alpha] : graph.edges) {
    const Eigen::Vector3d turned = 0.5 *
                                   (x.X.middleCols<3>(x.first[j]) + x.X.middleCols<3>(x.first[k])) *
                                   (graph.g.col(k) - graph.g.col(j));
    add(j, k, -turned);
    add(k, j, turned);
  }
  Eigen::SparseMatrix<double> laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt(laplacian);
  if (ldlt.info() != Eigen::Success) return;
  const Eigen::MatrixX3d p = ldlt.solve(b);
  if (!p.allFinite()) return;
  for (int j = 0; j < m; ++j) {
    if (row[j] >= 0) x.X.col(x.first[j] + 3) = p.row(row[j]).transpose() - graph.g.col(j);
  }
}

}  // namespace

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& R) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) = -U.col(2);
  return U * svd.matrixV().transpose();
}

bool turn_back(const DeformationGraph& graph, const Embedding& handles,
               const std::vector<char>& fixed, Unknowns& x) {
  const int m = x.nodes();
  bool any = false;
  const auto R = [&](int j) { return x.X.block<3, 3>(0, x.first[j]); };
  for (int j = 0; j < m; ++j) any |= !fixed[j] && R(j).determinant() < 0;
  if (!any) return false;

  const Neighbors around = neighbors(graph);
  std::vector<char> held = fixed;
  for (Eigen::Index i = 0; i < handles.nodes.size(); ++i) held[handles.nodes.data()[i]] = 1;
  Eigen::Matrix4Xd q(4, m);
  for (int j = 0; j < m; ++j) {
    Eigen::Matrix3d own = R(j);
    if (own.determinant() < 0) {
      const Eigen::Vector3d n = normal(graph, around[j], j);
      own -= 2 * own * n * n.transpose();
    }
    q.col(j) = Eigen::Quaterniond(nearest_rotation(own)).coeffs();
  }
  align(around, q);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int j = 0; j < m; ++j) {
      if (held[j]) continue;
      Eigen::Vector4d mean = q.col(j);
      for (const int k : around[j]) mean += q.col(k);
      if (mean.norm() > 1e-6) q.col(j) = mean.normalized();
    }
  }
  for (int j = 0; j < m; ++j) {
    if (!fixed[j]) R(j) = Eigen::Quaterniond(Eigen::Vector4d(q.col(j))).toRotationMatrix();
  }
  place(graph, held, x);
  return true;
}

}  // namespace deformlab
