#include "deformers/embedded/harmonic_start.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "deformers/embedded/handles/handle_groups.h"
#include "deformers/embedded/handles/line_turn.h"
#include "deformers/embedded/node_states.h"

namespace deformlab {
namespace {

constexpr double kAgrees = 0.1;  // [rad] two rotations that differ by less are the same motion
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastEdge = 1e-6;  // relative to the mean edge

using Triplets = std::vector<Eigen::Triplet<double>>;

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& omega) {
  const double angle = omega.norm();
  if (!(angle > 0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, omega / angle).toRotationMatrix();
}

// The rotation vector that takes the points p nearest to q.
Eigen::Vector3d fitted_rotation(const Eigen::Matrix3Xd& p, const Eigen::Matrix3Xd& q) {
  const auto from = p.colwise() - p.rowwise().mean(), to = q.colwise() - q.rowwise().mean();
  return rotation_vector(nearest_rotation(to * from.transpose()));
}

bool is_same_motion(const Eigen::Vector3d& fitted, const Eigen::Vector3d& asked) {
  return asked.allFinite() &&
         Eigen::AngleAxisd(rotation_of(fitted).transpose() * rotation_of(asked)).angle() < kAgrees;
}

// The free nodes of a linear problem, numbered.
struct Unknown {
  std::vector<int> number;  // of each node, −1 if it is known
  int count = 0;

  explicit Unknown(const std::vector<char>& known) {
    for (const char is_known : known) number.push_back(is_known ? -1 : count++);
  }
};

// Solves A x = b, of which only the lower triangle of A is given. Empty where A is singular.
Eigen::MatrixXd solved(const Triplets& A, const Eigen::MatrixXd& b) {
  Eigen::SparseMatrix<double> matrix(b.rows(), b.rows());
  matrix.setFromTriplets(A.begin(), A.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success) return {};
  const Eigen::MatrixXd x = factor.solve(b);
  return x.allFinite() ? x : Eigen::MatrixXd();
}

class HarmonicStart {
 public:
  explicit HarmonicStart(const StartProblem& problem)
      : p_(problem),
        m_(problem.graph.g.cols()),
        omega_(Eigen::Matrix3Xd::Zero(3, m_)),
        shortest_(kLeastEdge * mean_edge_length(problem.graph)) {}

  bool turn(const Eigen::Matrix3Xd& rotations) {
    const std::vector<char> known = hold(rotations);
    const Unknown unknown(known);
    if (unknown.count == 0) return true;
    Triplets A;
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(unknown.count, 3);
    for (const GraphEdge& edge : p_.graph.edges) {
      const double weight = std::pow(length(edge), -2);
      couple(edge.j, edge.k, weight, unknown, A, b);
      couple(edge.k, edge.j, weight, unknown, A, b);
    }
    const Eigen::MatrixXd x = solved(A, b);
    if (x.size() == 0) return false;
    for (Eigen::Index j = 0; j < m_; ++j) {
      if (unknown.number[j] >= 0) omega_.col(j) = x.row(unknown.number[j]).transpose();
    }
    return true;
  }

  std::optional<Transformations> move(const Eigen::Matrix3Xd& targets) {
    Transformations X = Transformations::Zero(3, 4 * m_);
    for (Eigen::Index j = 0; j < m_; ++j) X.middleCols<3>(4 * j) = rotation_of(omega_.col(j));
    const Unknown unknown(p_.fixed);
    if (unknown.count == 0) return X;
    Triplets A;
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(unknown.count, 3);
    for (const GraphEdge& edge : p_.graph.edges) add_edge(edge, X, unknown, A, b);
    for (Eigen::Index l = 0; l < p_.handles.v.cols(); ++l) {
      add_handle(l, targets.col(l), X, unknown, A, b);
    }
    const Eigen::MatrixXd t = solved(A, b);
    if (t.size() == 0) return std::nullopt;
    for (Eigen::Index j = 0; j < m_; ++j) {
      if (unknown.number[j] >= 0) X.col(4 * j + 3) = t.row(unknown.number[j]).transpose();
    }
    return X;
  }

 private:
  double length(const GraphEdge& edge) const {
    return std::max(shortest_, (p_.graph.g.col(edge.j) - p_.graph.g.col(edge.k)).norm());
  }

  // Sets the rotations that are known, and tells whose they are. In a component of the graph where
  // none is known, all are zero.
  std::vector<char> hold(const Eigen::Matrix3Xd& rotations) {
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(m_);
    for (Eigen::Index l = 0; l < rotations.cols(); ++l) {
      if (!rotations.col(l).allFinite()) continue;
      for (Eigen::Index a = 0; a < p_.handles.nodes.rows(); ++a) {
        const int j = p_.handles.nodes(a, l);
        omega_.col(j) += p_.handles.weights(a, l) * rotations.col(l);
        weight[j] += p_.handles.weights(a, l);
      }
    }
    std::vector<char> known = p_.fixed;
    const std::vector<int> component = components(p_.graph);
    std::vector<char> has_known(static_cast<std::size_t>(m_), 0);
    for (Eigen::Index j = 0; j < m_; ++j) {
      if (known[j]) omega_.col(j).setZero();
      if (weight[j] > 0 && !known[j]) omega_.col(j) /= weight[j], known[j] = 1;
      if (known[j]) has_known[component[j]] = 1;
    }
    for (Eigen::Index j = 0; j < m_; ++j) known[j] |= !has_known[component[j]];
    return known;
  }

  // The row of node j in the harmonic equations, as far as its edge to node k is concerned.
  void couple(int j, int k, double weight, const Unknown& unknown, Triplets& A,
              Eigen::MatrixXd& b) const {
    const int row = unknown.number[j], column = unknown.number[k];
    if (row < 0) return;
    A.emplace_back(row, row, weight);
    if (column < 0) b.row(row) += weight * omega_.col(k).transpose();
    if (column >= 0 && column < row) A.emplace_back(row, column, -weight);
  }

  // w_reg α (‖c_jk + t_j − t_k‖² + ‖c_kj + t_k − t_j‖²) with c_jk = (R_j − I)(g_k − g_j).
  void add_edge(const GraphEdge& edge, const Transformations& X, const Unknown& unknown,
                Triplets& A, Eigen::MatrixXd& b) const {
    const auto& [j, k, alpha] = edge;
    const double weight = p_.w_reg * alpha;
    const Eigen::Vector3d g_jk = p_.graph.g.col(k) - p_.graph.g.col(j);
    const Eigen::RowVector3d c =
        ((X.middleCols<3>(4 * j) + X.middleCols<3>(4 * k)) * g_jk - 2 * g_jk).transpose();
    const int row = unknown.number[j], column = unknown.number[k];
    if (row >= 0) A.emplace_back(row, row, 2 * weight), b.row(row) -= weight * c;
    if (column >= 0) A.emplace_back(column, column, 2 * weight), b.row(column) += weight * c;
    if (row >= 0 && column >= 0) {
      A.emplace_back(std::max(row, column), std::min(row, column), -2 * weight);
    }
  }

  // w_con ‖Σ_j w_j (R_j (v − g_j) + g_j + t_j) − q‖².
  void add_handle(Eigen::Index l, const Eigen::Vector3d& q, const Transformations& X,
                  const Unknown& unknown, Triplets& A, Eigen::MatrixXd& b) const {
    const auto nodes = p_.handles.nodes.col(l);
    const auto w = p_.handles.weights.col(l);
    Eigen::Vector3d left = q;
    for (Eigen::Index a = 0; a < nodes.size(); ++a) {
      const Eigen::Vector3d g = p_.graph.g.col(nodes[a]);
      left -= w[a] * (X.middleCols<3>(4 * nodes[a]) * (p_.handles.v.col(l) - g) + g);
    }
    for (Eigen::Index a = 0; a < nodes.size(); ++a) {
      const int row = unknown.number[nodes[a]];
      if (row < 0 || w[a] == 0) continue;
      b.row(row) += p_.w_con * w[a] * left.transpose();
      for (Eigen::Index c = 0; c < nodes.size(); ++c) {
        const int column = unknown.number[nodes[c]];
        if (column >= 0 && column <= row && w[c] != 0) {
          A.emplace_back(row, column, p_.w_con * w[a] * w[c]);
        }
      }
    }
  }

  const StartProblem& p_;
  const Eigen::Index m_;
  Eigen::Matrix3Xd omega_;
  const double shortest_;
};

}  // namespace

Eigen::Matrix3Xd handle_rotations(const Eigen::Matrix3Xd& v, const Eigen::Matrix3Xd& q,
                                  const Eigen::Matrix3Xd& asked, std::span<const int> groups) {
  Eigen::Matrix3Xd result =
      asked.cols() == v.cols() ? asked : Eigen::Matrix3Xd::Constant(3, v.cols(), kNaN);
  for (const std::vector<int>& handles : handle_groups(v.cols(), groups)) {
    const Eigen::Matrix3Xd from = v(Eigen::all, handles), to = q(Eigen::all, handles);
    const bool shows_all = spans_a_plane(from) && spans_a_plane(to);
    const auto turn = shows_all ? fitted_rotation(from, to) : shortest_turn(from, to);
    for (const int l : handles) {
      const bool is_told =
          shows_all ? is_same_motion(*turn, result.col(l)) : result.col(l).allFinite();
      if (turn && !is_told) result.col(l) = *turn;
    }
  }
  return result;
}

std::optional<Transformations> harmonic_start(const StartProblem& problem,
                                              const Eigen::Matrix3Xd& rotations,
                                              const Eigen::Matrix3Xd& targets) {
  HarmonicStart start(problem);
  if (!start.turn(rotations)) return std::nullopt;
  return start.move(targets);
}

}  // namespace deformlab
