#include <algorithm>

#include "deformers/arap_2d/handle_system.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

using Complex = std::complex<double>;
using Eigen::VectorXcd;
template <class Scalar>
using Sparse = Eigen::SparseMatrix<Scalar>;

// The n×n matrix V of v = V y. It contains the clusters' V in the rows and columns of their
// vertices, and is the identity elsewhere. Entries of y are prescribed by handles or free.
Sparse<double> change_of_basis(const MeshHandles& handles, Eigen::Index n) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<char> clustered(n, 0);
  for (const HandleCluster& cluster : handles.clusters) {
    for (int a = 0; a < std::ssize(cluster.vertices); ++a) {
      clustered[cluster.vertices[a]] = 1;
      for (int b = 0; b < std::ssize(cluster.vertices); ++b) {
        entries.emplace_back(cluster.vertices[a], cluster.vertices[b], cluster.V(a, b));
      }
    }
  }
  for (int i = 0; i < n; ++i) {
    if (!clustered[i]) entries.emplace_back(i, i, 1);
  }
  Sparse<double> V(n, n);
  V.setFromTriplets(entries.begin(), entries.end());
  return V;
}

// A linear system for y, from which the prescribed entries of y are eliminated.
template <class Scalar>
class EliminatedSystem {
 public:
  void compile(const Sparse<Scalar>& lower, const Sparse<Scalar>& V,
               const std::vector<char>& prescribed) {
    const Sparse<Scalar> A = lower.template selfadjointView<Eigen::Lower>();
    const Sparse<Scalar> AV = A * V;
    Sparse<Scalar> B = V.transpose() * AV;
    if (!factor_.factorize(
            eliminated(Sparse<Scalar>(B.template triangularView<Eigen::Lower>()), prescribed))) {
      throw InputError(
          "the system of the handles is singular in double precision: a part of the mesh between "
          "them cannot be deformed; use fewer handles, or other ones");
    }
    B.prune(
        [&](int row, int column, const Scalar&) { return prescribed[column] && !prescribed[row]; });
    coupling_ = std::move(B);
  }

  // On input the prescribed entries of y have their values, and the free ones their right-hand
  // sides. On output all of y is the solution.
  void solve(VectorXcd& y) const {
    for (int c = 0; c < coupling_.cols(); ++c) {
      for (typename Sparse<Scalar>::InnerIterator it(coupling_, c); it; ++it) {
        y[it.row()] -= it.value() * y[c];
      }
    }
    factor_.solve(y);
  }

 private:
  PanelCholesky<Scalar> factor_;
  Sparse<Scalar> coupling_;  // the entries in free rows and prescribed columns
};

class EliminationSystem final : public HandleSystem {
 public:
  explicit EliminationSystem(const RegisteredMesh& mesh) : mesh_(mesh), z_(mesh.p) {}

  void compile(const MeshHandles& handles) override {
    std::size_t largest = 0;
    std::vector<char> prescribed(z_.size(), 0);
    single_.clear();
    clusters_.clear();
    for (const HandleCluster& cluster : handles.clusters) {
      largest = std::max(largest, cluster.vertices.size());
      for (int i = 0; i < cluster.rank(); ++i) prescribed[cluster.vertices[i]] = 1;
      if (cluster.vertices.size() == 1 && cluster.points.size() == 1) {
        single_.push_back({cluster.vertices[0], cluster.points[0]});
      } else {
        clusters_.push_back(cluster);
      }
    }
    scratch_.resize(static_cast<Eigen::Index>(largest));
    const Sparse<double> V = change_of_basis(handles, z_.size());
    if (handles.distinct) G_.compile(mesh_.G, V.cast<Complex>(), prescribed);
    H_.compile(mesh_.H, V, prescribed);
  }

  const VectorXcd& step_one(const VectorXcd& q) override {
    z_.setZero();
    prescribe(q, z_);
    G_.solve(z_);
    transform<false>(z_);
    return z_;
  }

  void step_two(const VectorXcd& q, VectorXcd& z) override {
    transform<true>(z);
    prescribe(q, z);
    H_.solve(z);
    transform<false>(z);
  }

  const VectorXcd& intermediate() const override { return z_; }

 private:
  // A cluster of one vertex and one handle, where V = 1.
  struct Single {
    int vertex, handle;
  };

  void prescribe(const VectorXcd& q, VectorXcd& y) const {
    for (const auto& [vertex, handle] : single_) y[vertex] = q[handle];
    for (const HandleCluster& cluster : clusters_) {
      for (int i = 0; i < cluster.rank(); ++i) {
        Complex sum = 0;
        for (int j = 0; j < std::ssize(cluster.points); ++j) {
          sum += cluster.from_targets(i, j) * q[cluster.points[j]];
        }
        y[cluster.vertices[i]] = sum;
      }
    }
  }

  // Replaces y by V y, or by Vᵀ y.
  template <bool transposed>
  void transform(VectorXcd& y) {
    for (const HandleCluster& cluster : clusters_) {
      const auto m = std::ssize(cluster.vertices);
      for (int i = 0; i < m; ++i) scratch_[i] = y[cluster.vertices[i]];
      for (int i = 0; i < m; ++i) {
        Complex sum = 0;
        for (int j = 0; j < m; ++j) {
          sum += (transposed ? cluster.V(j, i) : cluster.V(i, j)) * scratch_[j];
        }
        y[cluster.vertices[i]] = sum;
      }
    }
  }

  const RegisteredMesh& mesh_;
  std::vector<Single> single_;
  std::vector<HandleCluster> clusters_;  // all other clusters
  EliminatedSystem<Complex> G_;
  EliminatedSystem<double> H_;
  VectorXcd z_, scratch_;
};

}  // namespace

std::unique_ptr<HandleSystem> make_elimination_system(const RegisteredMesh& mesh) {
  return std::make_unique<EliminationSystem>(mesh);
}

}  // namespace deformlab
