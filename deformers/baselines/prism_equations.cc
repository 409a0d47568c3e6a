#include "deformers/baselines/prism_equations.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace deformlab {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// R_i (p − b_i): the points p of a prism, relative to its centroid.
template <class Points>
Eigen::Matrix<double, 3, Points::ColsAtCompileTime> arms(const PrismLayer& prisms,
                                                         const RigidMotions& motions, int i,
                                                         const Points& p) {
  return motions.rotation(i) * (p.colwise() - prisms.b.col(i));
}

Eigen::Matrix3d cross_product_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d A;
  A << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return A;
}

// Σ JᵀJ′ over the columns of the arms a and b of two prisms. A point moves by J (ω, v) = ω×a + v.
template <class Arms>
Eigen::Matrix<double, 6, 6> product(const Arms& a, const Arms& b) {
  Eigen::Matrix<double, 6, 6> block;
  block.template topLeftCorner<3, 3>() =
      a.cwiseProduct(b).sum() * Eigen::Matrix3d::Identity() - b * a.transpose();
  block.template topRightCorner<3, 3>() = cross_product_matrix(a.rowwise().sum());
  block.template bottomLeftCorner<3, 3>() = -cross_product_matrix(b.rowwise().sum());
  block.template bottomRightCorner<3, 3>() = double(a.cols()) * Eigen::Matrix3d::Identity();
  return block;
}

// Σ Jᵀr over the columns of the arms a and the residuals r.
template <class Arms>
Vector6 torque_and_force(const Arms& a, const Arms& r) {
  Vector6 sum = Vector6::Zero();
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    sum.head<3>() += Eigen::Vector3d(a.col(k)).cross(Eigen::Vector3d(r.col(k)));
  }
  sum.tail<3>() = r.rowwise().sum();
  return sum;
}

// The positive semidefinite part of a symmetric matrix.
Eigen::Matrix3d convex_part(const Eigen::Matrix3d& K) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(K);
  const Eigen::Matrix3d& U = eigen.eigenvectors();
  return U * eigen.eigenvalues().cwiseMax(0).asDiagonal() * U.transpose();
}

}  // namespace

PrismEquations::PrismEquations(const PrismLayer& prisms, std::vector<Pin> pins,
                               const std::vector<char>& fixed)
    : prisms_(prisms), pins_(std::move(pins)), index_(fixed.size(), -1), solver_(make_cholmod()) {
  int n = 0;
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    if (!fixed[i]) index_[i] = n++;
  }
  Jtr_.setZero(6 * n);
  delta_.setZero(6 * n);
  if (n == 0) return;
  build_structure();
  find_order();
  build_structure();
  solver_->analyze(H_);
}

void PrismEquations::find_order() {
  const Eigen::VectorXi order = solver_->order(H_, 6);
  std::vector<int> new_index(rows_.size(), -1);
  int next = 0;
  for (const int unknown : order) {
    int& index = new_index[unknown / 6];
    if (index < 0) index = next++;  // the six unknowns of a prism stay together
  }
  for (int& index : index_) {
    if (index >= 0) index = new_index[index];
  }
}

// The c-th of a prism's six columns contains the diagonal block from row c on, and then the blocks
// of the later prisms that it is joined to.
void PrismEquations::build_structure() {
  const int n = unknowns() / 6;
  rows_.assign(n, {});
  for (const Joint& joint : prisms_.joints) {
    const auto [first, second] = std::minmax({index_[joint.i], index_[joint.j]});
    if (first >= 0) rows_[first].push_back(second);
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int b = 0; b < n; ++b) {
    std::sort(rows_[b].begin(), rows_[b].end());
    rows_[b].erase(std::unique(rows_[b].begin(), rows_[b].end()), rows_[b].end());
    for (int c = 0; c < 6; ++c) {
      for (int r = c; r < 6; ++r) entries.emplace_back(6 * b + r, 6 * b + c, 0);
      for (const int row : rows_[b]) {
        for (int r = 0; r < 6; ++r) entries.emplace_back(6 * row + r, 6 * b + c, 0);
      }
    }
  }
  H_.resize(6 * n, 6 * n);
  H_.setFromTriplets(entries.begin(), entries.end());
}

void PrismEquations::add_block(int row, int column, const Matrix6& block) {
  if (row < column) return add_block(column, row, block.transpose());
  double* values = H_.valuePtr();
  const int* begin = H_.outerIndexPtr() + std::ptrdiff_t(6) * column;
  const auto& rows = rows_[column];
  const auto below = std::lower_bound(rows.begin(), rows.end(), row) - rows.begin();
  for (int c = 0; c < 6; ++c) {
    if (row == column) {
      Eigen::Map<Eigen::VectorXd>(values + begin[c], 6 - c) += block.col(c).tail(6 - c);
    } else {
      Eigen::Map<Vector6>(values + begin[c] + 6 - c + 6 * below) += block.col(c);
    }
  }
}

double PrismEquations::joint_energy(const RigidMotions& motions) const {
  double sum = 0;
  for (const auto& [i, j, weight, p] : prisms_.joints) {
    const Eigen::Vector3d gap = motions.c.col(i) - motions.c.col(j);
    const Eigen::Matrix<double, 3, 4> r =
        arms(prisms_, motions, i, p) - arms(prisms_, motions, j, p);
    sum += weight * (r.colwise() + gap).squaredNorm();
  }
  return sum;
}

double PrismEquations::pin_energy(const RigidMotions& motions) const {
  double sum = 0;
  for (const Pin& pin : pins_) {
    const Eigen::Vector3d a = arms(prisms_, motions, pin.i, pin.p);
    sum += pin.weight * (a + motions.c.col(pin.i) - pin.target).squaredNorm();
  }
  return sum;
}

double PrismEquations::energy(const RigidMotions& motions) const {
  return joint_energy(motions) + pin_energy(motions);
}

void PrismEquations::linearize(const RigidMotions& motions) {
  Eigen::Map<Eigen::VectorXd>(H_.valuePtr(), H_.nonZeros()).setZero();
  Jtr_.setZero();
  Eigen::Matrix3Xd C = Eigen::Matrix3Xd::Zero(3, unknowns() / 2);
  for (const auto& [i, j, weight, p] : prisms_.joints) {
    const int I = index_[i], J = index_[j];
    if (I < 0 && J < 0) continue;
    const Eigen::Matrix<double, 3, 4> a = arms(prisms_, motions, i, p),
                                      b = arms(prisms_, motions, j, p);
    const Eigen::Vector3d gap = motions.c.col(i) - motions.c.col(j);
    const Eigen::Matrix<double, 3, 4> r = (a - b).colwise() + gap;
    if (I >= 0) add_block(I, I, weight * product(a, a));
    if (J >= 0) add_block(J, J, weight * product(b, b));
    if (I >= 0 && J >= 0) add_block(I, J, -weight * product(a, b));
    if (I >= 0) Jtr_.segment<6>(6 * I) += weight * torque_and_force(a, r);
    if (J >= 0) Jtr_.segment<6>(6 * J) -= weight * torque_and_force(b, r);
    if (I >= 0) C.middleCols<3>(3 * I) += weight * a * r.transpose();
    if (J >= 0) C.middleCols<3>(3 * J) -= weight * b * r.transpose();
  }
  for (const Pin& pin : pins_) {
    const int I = index_[pin.i];
    if (I < 0) continue;
    const Eigen::Vector3d a = arms(prisms_, motions, pin.i, pin.p);
    const Eigen::Vector3d r = a + motions.c.col(pin.i) - pin.target;
    add_block(I, I, pin.weight * product(a, a));
    Jtr_.segment<6>(6 * I) += pin.weight * torque_and_force(a, r);
    C.middleCols<3>(3 * I) += pin.weight * a * r.transpose();
  }
  add_curvature(C);
}

// A rotation moves an arm by ω×a + ½ ω×(ω×a). So half of E's second derivative is JᵀJ and, for each
// prism, ½(C + Cᵀ) − tr(C) I with C = Σ a rᵀ.
void PrismEquations::add_curvature(const Eigen::Matrix3Xd& C) {
  concave_.resize(3, C.cols());
  Matrix6 block = Matrix6::Zero();
  for (int I = 0; 6 * I < unknowns(); ++I) {
    const Eigen::Matrix3d c = C.middleCols<3>(3 * I);
    const Eigen::Matrix3d K = (c + c.transpose()) / 2 - c.trace() * Eigen::Matrix3d::Identity();
    block.topLeftCorner<3, 3>() = convex_part(K);
    add_block(I, I, block);
    concave_.middleCols<3>(3 * I) = K - block.topLeftCorner<3, 3>();
  }
}

bool PrismEquations::solve(bool full, double lambda, Eigen::MatrixXd& velocities) {
  damped_ = H_;
  double* values = damped_.valuePtr();
  for (int I = 0; 6 * I < unknowns(); ++I) {
    const int* begin = H_.outerIndexPtr() + std::ptrdiff_t(6) * I;
    double trace = 0;
    for (int c = 0; c < 6; ++c) trace += values[begin[c]];
    for (int c = 0; c < 6; ++c) values[begin[c]] += lambda * trace / 6;
    for (int c = 0; full && c < 3; ++c) {
      for (int r = c; r < 3; ++r) values[begin[c] + r - c] += concave_(r, 3 * I + c);
    }
  }
  if (!solver_->factorize(damped_)) return false;
  solver_->solve(-Jtr_, delta_);
  velocities.setZero(6, std::ssize(index_));
  for (int i = 0; i < velocities.cols(); ++i) {
    if (index_[i] >= 0) velocities.col(i) = delta_.segment<6>(6 * index_[i]);
  }
  return delta_.allFinite();
}

double PrismEquations::slope(const Eigen::MatrixXd& velocities) const {
  double sum = 0;
  for (int i = 0; i < velocities.cols(); ++i) {
    if (index_[i] >= 0) sum += velocities.col(i).dot(Jtr_.segment<6>(6 * index_[i]));
  }
  return sum;
}

}  // namespace deformlab
