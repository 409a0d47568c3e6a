#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "deformers/arap_2d/handle_system.h"

namespace deformlab {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd, Eigen::VectorXcd;

// For up to this number of handles, adding up their columns is cheaper than solving for the sum.
constexpr int kFewHandles = 16;
constexpr Eigen::Index kBlock = 256;  // rows of columns that are added up at once

// What one handle adds to both steps. It depends on the handle's place alone, and so it is kept
// while other handles come and go. With c for the handle's row of barycentric coordinates and L for
// the factors of the registration:
struct HandleColumns {
  BarycentricPoint point;
  SparseColumn g, h;  // L⁻¹ cᴴ for G and for H
  VectorXcd v;        // G⁻¹ cᴴ, or empty if there have always been many handles
};
using HandlePointers = std::vector<std::shared_ptr<HandleColumns>>;

bool operator==(const HandleColumns& handle, const BarycentricPoint& point) {
  return handle.point.vertices == point.vertices && handle.point.b == point.b;
}

// How the minimum of vᴴAv − 2 Re vᴴb subject to P C v = P q responds to the gaps q − C v̂, where
// A v̂ = b. The rows of C are the handles' c, and the columns of N span the null space of A:
// translations and, in step one, rotations and scalings. The minimum is
//   v = v̂ + A⁻¹Cᴴ f + N τ,   f = Pᵀλ,   with   P S Pᵀ λ + P C N τ = P (q − C v̂),   (P C N)ᴴ λ = 0,
// where S = C A⁻¹ Cᴴ, and λ are forces that have no component in the null space.
class Response {
 public:
  // Adapts S to other handles.
  //   before  the index that each handle had in the last call, or −1
  //   half    L⁻¹ cᴴ
  void change_handles(const HandlePointers& handles, const std::vector<int>& before,
                      SparseColumn HandleColumns::*half, VectorXcd& zeros) {
    const auto k = std::ssize(handles);
    const MatrixXcd last = std::exchange(S_, MatrixXcd(k, k));
    for (Eigen::Index i = 0; i < k; ++i) {
      if (before[i] < 0) zeros += (*handles[i]).*half;
      for (Eigen::Index j = 0; j < k; ++j) {
        if (before[i] >= 0 && before[j] >= 0) {
          S_(j, i) = last(before[j], before[i]);
        } else if (before[i] < 0 && (before[j] >= 0 || j <= i)) {
          S_(j, i) = ((*handles[j]).*half).dot(zeros);
          S_(i, j) = std::conj(S_(j, i));
        }
      }
      if (before[i] < 0) {
        for (SparseColumn::InnerIterator it((*handles[i]).*half); it; ++it) zeros[it.index()] = 0;
      }
    }
  }

  //   CN  #handles × dimension of the null space
  void compile(const Eigen::SparseMatrix<Complex>& P, const MatrixXcd& CN) {
    const Eigen::Index r = P.rows(), d = CN.cols();
    const double largest = S_.diagonal().real().maxCoeff();
    const double unit = largest > 0 ? largest : 1;  // gives S and C N the same scale
    MatrixXcd K = MatrixXcd::Zero(r + d, r + d), right = MatrixXcd::Zero(r + d, P.cols());
    K.topLeftCorner(r, r) = P * (S_ / unit) * P.transpose();
    K.topRightCorner(r, d) = P * CN;
    K.bottomLeftCorner(d, r) = K.topRightCorner(r, d).adjoint();
    right.topRows(r) = P;
    const MatrixXcd X = K.partialPivLu().solve(right);
    // As many conditions as dimensions leave no forces.
    to_forces_.resize(0, P.cols());
    if (r > d) to_forces_ = P.transpose() * X.topRows(r) / unit;
    to_null_ = X.bottomRows(d);
    forces.resize(to_forces_.rows());
    null.resize(d);
  }

  void respond(const VectorXcd& gaps) {
    forces.noalias() = to_forces_.lazyProduct(gaps);
    null.noalias() = to_null_.lazyProduct(gaps);
  }

  VectorXcd forces, null;  // f and τ

 private:
  MatrixXcd S_, to_forces_, to_null_;
};

class SchurComplementSystem final : public HandleSystem {
 public:
  explicit SchurComplementSystem(const RegisteredMesh& mesh)
      : mesh_(mesh), zeros_(VectorXcd::Zero(mesh.p.size())), v_(mesh.p) {}

  void compile(const MeshHandles& handles) override {
    change_handles(handles.points);
    const auto k = std::ssize(handles.points);
    const Eigen::SparseMatrix<Complex> P = conditions_of(handles);
    MatrixXcd CN = MatrixXcd::Ones(k, 2);
    for (Eigen::Index i = 0; i < k; ++i) CN(i, 1) = handles.points[i](mesh_.p) / mesh_.extent;
    if (handles.distinct) one_.compile(P, CN);
    two_.compile(P, CN.leftCols<1>());
    gaps_.resize(k);
  }

  const VectorXcd& step_one(const VectorXcd& q) override {
    one_.respond(q);
    const VectorXcd& f = one_.forces;
    const Complex translation = one_.null[0], similarity = one_.null[1] / mesh_.extent;
    if (f.size() > kFewHandles) {
      v_.setZero();
      for (Eigen::Index i = 0; i < f.size(); ++i) v_ += f[i] * handles_[i]->g;
      mesh_.G_grounded.solve_upper(v_);
      v_.array() += similarity * mesh_.p.array() + translation;
      return v_;
    }
    for (Eigen::Index first = 0; first < v_.size(); first += kBlock) {
      const Eigen::Index rows = std::min(kBlock, v_.size() - first);
      auto v = v_.segment(first, rows);
      v.array() = similarity * mesh_.p.segment(first, rows).array() + translation;
      for (Eigen::Index i = 0; i < f.size(); ++i) v += f[i] * handles_[i]->v.segment(first, rows);
    }
    return v_;
  }

  void step_two(const VectorXcd& q, VectorXcd& z) override {
    z[mesh_.grounded[0]] = 0;
    mesh_.H_grounded.solve_lower(z);
    // Half a solve suffices for the positions c z of the handles.
    for (Eigen::Index i = 0; i < q.size(); ++i) gaps_[i] = q[i] - handles_[i]->h.dot(z);
    two_.respond(gaps_);
    for (Eigen::Index i = 0; i < two_.forces.size(); ++i) z += two_.forces[i] * handles_[i]->h;
    mesh_.H_grounded.solve_upper(z);
    z.array() += two_.null[0];
  }

  const VectorXcd& intermediate() const override { return v_; }

 private:
  // Computes what is new: two half solves for each new handle, and a third one where there are few.
  void change_handles(const std::vector<BarycentricPoint>& points) {
    HandlePointers handles;
    std::vector<int> before;
    for (const BarycentricPoint& point : points) {
      const auto is_here = [&](const auto& handle) { return *handle == point; };
      const auto kept = std::ranges::find_if(handles_, is_here);
      const auto same = std::ranges::find_if(handles, is_here);
      before.push_back(kept == handles_.end() ? -1 : static_cast<int>(kept - handles_.begin()));
      handles.push_back(kept != handles_.end()  ? *kept
                        : same != handles.end() ? *same
                                                : make_columns(point));
      VectorXcd& v = handles.back()->v;
      if (v.size() > 0 || std::ssize(points) > kFewHandles) continue;
      v = handles.back()->g;
      mesh_.G_grounded.solve_upper(v);
    }
    handles_ = std::move(handles);
    one_.change_handles(handles_, before, &HandleColumns::g, zeros_);
    two_.change_handles(handles_, before, &HandleColumns::h, zeros_);
  }

  std::shared_ptr<HandleColumns> make_columns(const BarycentricPoint& point) {
    SparseColumn c(mesh_.p.size());
    for (int i = 0; i < 3; ++i) c.coeffRef(point.vertices[i]) += point.b[i];
    c.coeffRef(mesh_.grounded[0]) = 0;
    SparseColumn h = mesh_.H_grounded.solve_lower(c, zeros_);
    c.coeffRef(mesh_.grounded[1]) = 0;
    return std::make_shared<HandleColumns>(
        HandleColumns{point, mesh_.G_grounded.solve_lower(c, zeros_), std::move(h), {}});
  }

  // The matrix P, which maps targets to the prescribed combinations of vertices.
  static Eigen::SparseMatrix<Complex> conditions_of(const MeshHandles& handles) {
    std::vector<Eigen::Triplet<Complex>> entries;
    Eigen::Index first = 0;
    for (const HandleCluster& cluster : handles.clusters) {
      for (int row = 0; row < cluster.rank(); ++row) {
        for (int j = 0; j < std::ssize(cluster.points); ++j) {
          entries.emplace_back(first + row, cluster.points[j], cluster.from_targets(row, j));
        }
      }
      first += cluster.rank();
    }
    Eigen::SparseMatrix<Complex> P(first, std::ssize(handles.points));
    P.setFromTriplets(entries.begin(), entries.end());
    return P;
  }

  const RegisteredMesh& mesh_;
  VectorXcd zeros_;
  HandlePointers handles_;
  Response one_, two_;
  VectorXcd gaps_, v_;
};

}  // namespace

std::unique_ptr<HandleSystem> make_schur_complement_system(const RegisteredMesh& mesh) {
  return std::make_unique<SchurComplementSystem>(mesh);
}

}  // namespace deformlab
