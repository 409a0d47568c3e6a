#include <algorithm>

#include "deformers/arap_2d/handle_system.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

using Complex = std::complex<double>;
using Eigen::VectorXcd;
template <class Scalar>
using Sparse = Eigen::SparseMatrix<Scalar>;

// v = V y, with the clusters' V in the rows and columns of their vertices: of y each entry is
// either held or free.
Sparse<double> change_of_basis(const Held& held, Eigen::Index n) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<char> clustered(n, 0);
  for (const Cluster& cluster : held.clusters) {
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

// A system with what is held eliminated.
template <class Scalar>
class Eliminated {
 public:
  void compile(const Sparse<Scalar>& lower, const Sparse<double>& V,
               const std::vector<char>& held) {
    const Sparse<Scalar> A = lower.template selfadjointView<Eigen::Lower>();
    const Sparse<Scalar> W = V.template cast<Scalar>();
    const Sparse<Scalar> AW = A * W;
    Sparse<Scalar> B = W.transpose() * AW;
    if (!factor_.factorize(
            without(Sparse<Scalar>(B.template triangularView<Eigen::Lower>()), held))) {
      throw InputError(
          "the handles leave a part of the mesh that cannot be deformed in double precision; use "
          "fewer, or others");
    }
    B.prune([&](int row, int column, const Scalar&) { return held[column] && !held[row]; });
    coupling_ = std::move(B);
  }

  // y, where it is held, and the right-hand side, where it is free, become all of y.
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
  Sparse<Scalar> coupling_;  // of free rows to held columns
};

class ManyHeld final : public HandleSystem {
 public:
  ManyHeld(const RegisteredMesh& mesh, const Held& held) : turns_(held.turns) {
    const Eigen::Index n = mesh.p.size();
    std::size_t largest = 0;
    std::vector<char> is_held(n, 0);
    for (const Cluster& cluster : held.clusters) {
      largest = std::max(largest, cluster.vertices.size());
      for (int i = 0; i < cluster.rank(); ++i) is_held[cluster.vertices[i]] = 1;
      if (cluster.vertices.size() == 1 && cluster.places.size() == 1) {
        alone_.push_back({cluster.vertices[0], cluster.places[0]});
      } else {
        clusters_.push_back(cluster);
      }
    }
    scratch_.resize(static_cast<Eigen::Index>(largest));
    const Sparse<double> V = change_of_basis(held, n);
    if (turns_) G_.compile(mesh.G, V, is_held);
    H_.compile(mesh.H, V, is_held);
    z_.resize(n);
  }

  void step_one(const VectorXcd& q) override {
    if (!turns_) return;
    z_.setZero();
    hold(q, z_);
    G_.solve(z_);
    transform<false>(z_);
  }

  void fit(TriangleFit& triangles) const override {
    if (turns_) triangles.fit(z_);
  }

  void step_two(const VectorXcd& q, VectorXcd& z) override {
    transform<true>(z);
    hold(q, z);
    H_.solve(z);
    transform<false>(z);
  }

  VectorXcd intermediate() const override { return z_; }

 private:
  struct Alone {
    int vertex, place;
  };

  void hold(const VectorXcd& q, VectorXcd& y) const {
    for (const auto& [vertex, place] : alone_) y[vertex] = q[place];
    for (const Cluster& cluster : clusters_) {
      for (int i = 0; i < cluster.rank(); ++i) {
        Complex sum = 0;
        for (int j = 0; j < std::ssize(cluster.places); ++j) {
          sum += cluster.pull(i, j) * q[cluster.places[j]];
        }
        y[cluster.vertices[i]] = sum;
      }
    }
  }

  // v = V y, or Vᵀ v.
  template <bool transposed>
  void transform(VectorXcd& y) {
    for (const Cluster& cluster : clusters_) {
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

  bool turns_;
  std::vector<Alone> alone_;  // clusters of one vertex and one place, where V = 1
  std::vector<Cluster> clusters_;
  Eliminated<Complex> G_;
  Eliminated<double> H_;
  VectorXcd z_, scratch_;
};

}  // namespace

std::unique_ptr<HandleSystem> make_many_held(const RegisteredMesh& mesh, const Held& held) {
  return std::make_unique<ManyHeld>(mesh, held);
}

}  // namespace deformlab
