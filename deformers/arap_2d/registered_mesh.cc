#include "deformers/arap_2d/registered_mesh.h"

#include "deformers/arap_2d/component_motion.h"
#include "deformers/arap_2d/connectivity.h"
#include "geometry/core/error.h"
#include "solvers/linear/linear_solver.h"

namespace deformlab {
namespace {

using Complex = std::complex<double>;

constexpr int kFewVertices = 16;  // the order of so few vertices does not matter

// The sparsity pattern of H, from which the order is computed: an entry for each edge and vertex.
SparseMatrix pattern_of_H(Eigen::Index n, const Eigen::Matrix3Xi& F) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto corners : F.colwise()) {
    for (const int i : corners) {
      for (const int j : corners) {
        if (i >= j) entries.emplace_back(i, j, 1);
      }
    }
  }
  SparseMatrix result(n, n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

// Eq. 1–4: the errors of a triangle are e·v' / e_c for its corners c, where e are the edges
// opposite to the corners. The triangle adds w Σ_c 1/|e_c|² · ē eᵀ to G.
void add_similarity(const Eigen::Vector3i& corners, const Eigen::VectorXcd& p, double w,
                    std::vector<Eigen::Triplet<Complex>>& G) {
  Eigen::Vector3cd e;
  for (int c = 0; c < 3; ++c) e[c] = p[corners[(c + 1) % 3]] - p[corners[(c + 2) % 3]];
  // Lengths are divided by the longest first, because squares of very small or large ones may
  // underflow or overflow.
  e /= e.cwiseAbs().maxCoeff();
  w *= e.cwiseAbs2().cwiseInverse().sum();
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      if (corners[a] < corners[b]) continue;
      const Complex entry = a == b ? Complex(std::norm(e[a])) : std::conj(e[a]) * e[b];
      G.emplace_back(corners[a], corners[b], w * entry);
    }
  }
}

}  // namespace

RegisteredMesh::RegisteredMesh(const Triangulation& mesh, const Eigen::VectorXd& weights) {
  sort_vertices(mesh, weights);
  assemble(mesh, weights);
  ground();
}

void RegisteredMesh::sort_vertices(const Triangulation& mesh, const Eigen::VectorXd& weights) {
  const Eigen::Index n = mesh.V.cols();
  order = n > kFewVertices ? make_cholmod()->order(pattern_of_H(n, mesh.F))
                           : Eigen::VectorXi::LinSpaced(n, 0, static_cast<int>(n) - 1);
  index.resize(n);
  for (int i = 0; i < n; ++i) index[order[i]] = i;
  p.resize(n);
  p.real() = mesh.V.row(0)(order);
  p.imag() = mesh.V.row(1)(order);
  p.array() -= p.mean();
  extent = extent_of(p);
  F = index(mesh.F.reshaped()).reshaped(3, mesh.F.cols());
  fit = TriangleFit(p, F, weights);
}

void RegisteredMesh::assemble(const Triangulation& mesh, const Eigen::VectorXd& weights) {
  std::vector<Eigen::Triplet<Complex>> similarity;
  std::vector<Eigen::Triplet<double>> edges;
  for (Eigen::Index f = 0; f < F.cols(); ++f) {
    add_similarity(F.col(f), p, weights[f], similarity);
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        const double value = (a == b ? 2 : -1) * weights[f];
        if (F(a, f) >= F(b, f)) edges.emplace_back(F(a, f), F(b, f), value);
      }
    }
  }
  const Hinges weak = hinges(mesh, weights);
  for (Eigen::Index h = 0; h < weak.F.cols(); ++h) {
    add_similarity(index(weak.F.col(h)), p, weak.weights[h], similarity);
  }
  G.resize(p.size(), p.size());
  G.setFromTriplets(similarity.begin(), similarity.end());
  H.resize(p.size(), p.size());
  H.setFromTriplets(edges.begin(), edges.end());
}

void RegisteredMesh::ground() {
  // The last vertex is the root of the elimination tree, so that no other column of the factor
  // changes without it.
  const Eigen::Index last = p.size() - 1;
  Eigen::Index far = 0;
  (p.array() - p[last]).abs().maxCoeff(&far);
  grounded = {static_cast<int>(last), static_cast<int>(far)};
  std::vector<char> fixed(p.size(), 0);
  fixed[last] = 1;
  const bool regular = H_grounded.factorize(eliminated(H, fixed));
  fixed[far] = 1;
  if (G_grounded.factorize(eliminated(G, fixed)) && regular) return;
  throw InputError(
      "the mesh cannot be deformed in double precision: some triangles are too thin, or their "
      "weights differ too much; use a mesh of rounder triangles, or weights nearer to each other");
}

}  // namespace deformlab
