#include <Eigen/QR>
#include <algorithm>
#include <utility>

#include "deformers/arap_2d/handle_system.h"

namespace deformlab {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd, Eigen::MatrixXd, Eigen::VectorXcd;

// The conditions C v = P q that the handles impose on the positions v.
struct Conditions {
  Eigen::SparseMatrix<double, Eigen::RowMajor> C;  // r×n, with orthonormal rows
  MatrixXd P;                                      // r×#handles
};

Conditions conditions_of(const MeshHandles& handles, Eigen::Index n) {
  std::vector<Eigen::Triplet<double>> entries;
  const Eigen::Index r = handles.rank();
  Conditions conditions{{r, n}, MatrixXd::Zero(r, std::ssize(handles.points))};
  int first = 0;
  for (const HandleCluster& cluster : handles.clusters) {
    for (int row = 0; row < cluster.rank(); ++row) {
      for (int i = 0; i < std::ssize(cluster.vertices); ++i) {
        entries.emplace_back(first + row, cluster.vertices[i], cluster.V(i, row));
      }
      conditions.P(first + row, cluster.points) = cluster.from_targets.row(row);
    }
    first += static_cast<int>(cluster.rank());
  }
  conditions.C.setFromTriplets(entries.begin(), entries.end());
  return conditions;
}

// How the minimum of vᴴAv − 2 Re vᴴb subject to C v = c responds to the values c. The columns of N
// span the null space of A: translations and, in step one, rotations and scaling. The minimum is
//   v = v̂ + Y μ + N τ,   μ = M (c − C v̂),   τ = T (c − C v̂),
// where v̂ is any solution of A v̂ = b, and Y = A⁺Cᴴ W. W is an orthonormal basis of the orthogonal
// complement of C N. Its columns are forces on the handles that have no component in the null
// space, so that A v = Cᴴ W has a solution.
template <class Scalar>
struct Response {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  Matrix Y;     // n×(r − columns of N)
  Matrix M, T;  // (r − columns of N)×r, columns of N×r

  // `solve(Y)` replaces each column of Y by a solution v of A v = column.
  template <class Solve>
  Response(const Conditions& conditions, const Matrix& N, Solve&& solve) {
    const Eigen::SparseMatrix<Scalar, Eigen::RowMajor> C = conditions.C.template cast<Scalar>();
    const Matrix B = C * N;
    const Eigen::Index r = B.rows(), m = r - B.cols();
    const Matrix Q = Eigen::HouseholderQR<Matrix>(B).householderQ() * Matrix::Identity(r, r);
    const Matrix W = Q.rightCols(m);
    Y = C.transpose() * W;
    solve(Y);
    const Matrix CY = C * Y;
    M = Matrix::Zero(m, r);
    if (m > 0) {
      M = (W.adjoint() * CY).eval().completeOrthogonalDecomposition().solve(W.adjoint());
    }
    T = B.completeOrthogonalDecomposition().solve(Matrix::Identity(r, r) - CY * M);
  }
};

class SchurComplementSystem final : public HandleSystem {
 public:
  SchurComplementSystem(const RegisteredMesh& mesh, const MeshHandles& handles)
      : mesh_(mesh), points_(handles.points), gap_(std::ssize(handles.points)) {
    const Conditions conditions = conditions_of(handles, mesh.p.size());
    if (handles.distinct) compile_step_one(conditions);
    compile_step_two(conditions);
  }

  void step_one(const VectorXcd& q) override {
    mu_.noalias() = to_mu_.lazyProduct(q);
    tau_.noalias() = to_tau_.lazyProduct(q);
  }

  void fit(TriangleFit& triangles) const override {
    if (tau_.size() > 0) triangles.fit(tau_[1], s_re_, s_im_, mu_);
  }

  void step_two(const VectorXcd& q, VectorXcd& z) override {
    z[mesh_.grounded[0]] = 0;
    mesh_.H_grounded.solve(z);
    for (Eigen::Index i = 0; i < q.size(); ++i) gap_[i] = q[i] - points_[i](z);
    lambda_.noalias() = to_lambda_.lazyProduct(gap_);
    const Complex t = to_translation_.cwiseProduct(gap_.transpose()).sum();
    const Eigen::Index m = lambda_.size();
    const double* y = Z_.data();
    for (Eigen::Index i = 0; i < z.size(); ++i, y += m) {
      double re = z[i].real() + t.real(), im = z[i].imag() + t.imag();
      for (Eigen::Index l = 0; l < m; ++l) {
        re += y[l] * lambda_[l].real();
        im += y[l] * lambda_[l].imag();
      }
      z[i] = {re, im};
    }
  }

  VectorXcd intermediate() const override {
    return ((Y_ * mu_ + tau_[1] * mesh_.p).array() + tau_[0]).matrix();
  }

 private:
  void compile_step_one(const Conditions& conditions) {
    const double size = mesh_.p.cwiseAbs().maxCoeff();  // gives both columns of N the same scale
    MatrixXcd N(mesh_.p.size(), 2);
    N << VectorXcd::Ones(mesh_.p.size()), mesh_.p / size;
    Response<Complex> response(conditions, N, [this](MatrixXcd& Y) {
      for (const int i : mesh_.grounded) Y.row(i).setZero();
      VectorXcd column;
      for (Eigen::Index l = 0; l < Y.cols(); ++l) {
        column = Y.col(l);
        mesh_.G_grounded.solve(column);
        Y.col(l) = column;
      }
    });
    Y_ = std::move(response.Y);
    to_mu_ = response.M * conditions.P;
    to_tau_ = response.T * conditions.P;
    to_tau_.row(1) /= size;
    mu_.resize(Y_.cols());
    tau_.resize(2);
    s_re_.resize(mesh_.fit.size(), Y_.cols());
    s_im_.resize(mesh_.fit.size(), Y_.cols());
    for (Eigen::Index l = 0; l < Y_.cols(); ++l) {
      const VectorXcd s = mesh_.fit.similarities(Y_.col(l));
      s_re_.col(l) = s.real();
      s_im_.col(l) = s.imag();
    }
  }

  void compile_step_two(const Conditions& conditions) {
    const MatrixXd N = MatrixXd::Ones(mesh_.p.size(), 1);
    Response<double> response(conditions, N, [this](MatrixXd& Y) {
      Y.row(mesh_.grounded[0]).setZero();
      VectorXcd two(Y.rows());  // solves for two real right-hand sides at once
      for (Eigen::Index l = 0; l < Y.cols(); l += 2) {
        const Eigen::Index next = std::min(l + 1, Y.cols() - 1);
        two.real() = Y.col(l);
        two.imag() = Y.col(next);
        mesh_.H_grounded.solve(two);
        Y.col(l) = two.real();
        Y.col(next) = next == l ? Y.col(l).eval() : two.imag().eval();
      }
    });
    Z_ = response.Y;
    to_lambda_ = (response.M * conditions.P).cast<Complex>();
    to_translation_ = (response.T * conditions.P).cast<Complex>();
    lambda_.resize(Z_.cols());
  }

  const RegisteredMesh& mesh_;
  std::vector<BarycentricPoint> points_;
  // Step one: v' = Y μ + τ_0 + τ_1 p. The similarities of its triangles are
  // s = τ_1 + (s_re + i s_im) μ.
  MatrixXcd Y_, to_mu_, to_tau_;
  Eigen::ArrayXXd s_re_, s_im_;
  VectorXcd mu_, tau_;
  // Step two: v'' = z + Z λ + t, where λ and t are linear in the gaps between handles and targets.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> Z_;
  MatrixXcd to_lambda_;
  Eigen::RowVectorXcd to_translation_;
  VectorXcd gap_, lambda_;
};

}  // namespace

std::unique_ptr<HandleSystem> make_schur_complement_system(const RegisteredMesh& mesh,
                                                           const MeshHandles& handles) {
  return std::make_unique<SchurComplementSystem>(mesh, handles);
}

}  // namespace deformlab
