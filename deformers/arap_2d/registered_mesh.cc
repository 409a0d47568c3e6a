#include "deformers/arap_2d/registered_mesh.h"

#include <algorithm>
#include <numeric>

#include "deformers/arap_2d/component_motion.h"
#include "deformers/arap_2d/connectivity.h"
#include "geometry/core/error.h"
#include "solvers/linear/linear_solver.h"

namespace deformlab {
namespace {

using Complex = std::complex<double>;

constexpr int kFewVertices = 16;  // the order of so few vertices does not matter

// A lower triangle of zeros, with an entry for each pair of corners of a triangle (3×#F) and for
// each of the n vertices.
SparseMatrix structure_of(const Eigen::Matrix3Xi& F, Eigen::Index n) {
  std::vector<int> begin(n + 2, 0);  // where the rows of each column begin, which repeat themselves
  const auto for_each_pair = [&](auto&& visit) {
    for (const auto f : F.colwise()) {
      for (int c = 0; c < 3; ++c) {
        const auto [column, row] = std::minmax({f[c], f[(c + 1) % 3]});
        visit(row, column);
      }
    }
  };
  for_each_pair([&](int, int column) { ++begin[column + 2]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<int> rows(begin.back());
  for_each_pair([&](int row, int column) { rows[begin[column + 1]++] = row; });
  SparseMatrix result(n, n);
  result.reserve(n + std::ssize(rows));
  for (int c = 0; c < n; ++c) {
    const auto first = rows.begin() + begin[c], end = rows.begin() + begin[c + 1];
    std::sort(first, end);
    result.startVec(c);
    result.insertBack(c, c) = 0;
    std::for_each(first, std::unique(first, end), [&](int r) { result.insertBack(r, c) = 0; });
  }
  result.finalize();
  return result;
}

// Eq. 1–4: the errors of a triangle are e·v' / e_c for its corners c, where e are the edges
// opposite to the corners. The triangle adds w Σ_c 1/|e_c|² · ē eᵀ to G. Returns this matrix.
Eigen::Matrix3cd similarity(const Eigen::Vector3i& corners, const Eigen::VectorXcd& p, double w) {
  Eigen::Vector3cd e;
  for (int c = 0; c < 3; ++c) e[c] = p[corners[(c + 1) % 3]] - p[corners[(c + 2) % 3]];
  // Lengths are divided by the longest first, because squares of very small or large ones may
  // underflow or overflow.
  e /= e.cwiseAbs().maxCoeff();
  w *= e.cwiseAbs2().cwiseInverse().sum();
  return w * (e.conjugate() * e.transpose());
}

// Adds a triangle's matrix to the values of a lower triangle that has entries for it.
template <class Scalar>
void add(const Eigen::Vector3i& corners, const Eigen::Matrix<Scalar, 3, 3>& entries,
         Eigen::SparseMatrix<Scalar>& lower) {
  for (int b = 0; b < 3; ++b) {
    const int* begin = lower.innerIndexPtr() + lower.outerIndexPtr()[corners[b]];
    for (int a = 0; a < 3; ++a) {
      if (corners[a] < corners[b]) continue;
      const int* row = begin;
      while (*row != corners[a]) ++row;
      lower.valuePtr()[row - lower.innerIndexPtr()] += entries(a, b);
    }
  }
}

}  // namespace

RegisteredMesh::RegisteredMesh(const Triangulation& mesh, const Eigen::VectorXd& weights) {
  Hinges weak = hinges(mesh, weights);
  Eigen::Matrix3Xi all(3, mesh.F.cols() + weak.F.cols());
  all << mesh.F, weak.F;
  sort_vertices(mesh, structure_of(all, mesh.V.cols()));
  F = index(mesh.F.reshaped()).reshaped(3, mesh.F.cols());
  fit = TriangleFit(p, F, weights);
  all = index(all.reshaped().eval()).reshaped(3, all.cols());
  H = structure_of(all, p.size());
  G = H.cast<Complex>();
  assemble(all, weights, weak.weights);
  ground();
}

void RegisteredMesh::sort_vertices(const Triangulation& mesh, const SparseMatrix& structure) {
  const Eigen::Index n = mesh.V.cols();
  order = n > kFewVertices ? make_cholmod()->order(structure, 1, true)
                           : Eigen::VectorXi::LinSpaced(n, 0, static_cast<int>(n) - 1);
  index.resize(n);
  for (int i = 0; i < n; ++i) index[order[i]] = i;
  p.resize(n);
  p.real() = mesh.V.row(0)(order);
  p.imag() = mesh.V.row(1)(order);
  p.array() -= p.mean();
  extent = extent_of(p);
}

void RegisteredMesh::assemble(const Eigen::Matrix3Xi& all, const Eigen::VectorXd& weights,
                              const Eigen::VectorXd& weak) {
  const Eigen::Matrix3d edges = 3 * Eigen::Matrix3d::Identity() - Eigen::Matrix3d::Ones();
  for (Eigen::Index f = 0; f < all.cols(); ++f) {
    const bool is_hinge = f >= weights.size();
    const double w = is_hinge ? weak[f - weights.size()] : weights[f];
    const Eigen::Vector3i corners = all.col(f);
    add<Complex>(corners, similarity(corners, p, w), G);
    if (!is_hinge) add<double>(corners, w * edges, H);
  }
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
