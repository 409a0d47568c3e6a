#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "energies/term_energy.h"
#include "energies/term_options.h"
#include "tests/support/samples.h"
#include "tests/support/sparse_system.h"

// The laws that every term has to obey. Each is a function, so that a test can show that it finds a
// term which breaks the law.
namespace deformlab::test {

using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;

/// The node model of a term over a graph; void for other terms.
template <class Term>
struct ModelOf {
  using Type = void;
};
template <template <class> class Term, class Node>
struct ModelOf<Term<Node>> {
  using Type = Node;
};

/// The sum of any term, whatever its `over` takes.
template <class Term>
Terms<Term> sum_over(const Sample& sample) {
  if constexpr (HasOptions<Term>) {
    return Term::over(sample.context(), typename Term::Options{});
  } else if constexpr (requires { Term::over(sample.context()); }) {
    return Term::over(sample.context());
  } else if constexpr (requires { Term::over(sample.mesh, sample.weights); }) {
    return Term::over(sample.mesh, sample.weights);
  } else {
    return Term::over(sample.mesh, sample.points);
  }
}

/// The rest state of what the term is summed over: the nodes of a graph, or the vertices of a
/// triangulation unless the term has nodes of its own.
template <class Term>
Unknowns rest_of(const Sample& sample) {
  using Node = typename ModelOf<Term>::Type;
  if constexpr (!std::is_void_v<Node>) {
    return sample.rest<Node>();
  } else if constexpr (requires { Term::rest(sample.mesh); }) {
    return Term::rest(sample.mesh);
  } else {
    return Unknowns::uniform(sample.mesh.V, static_cast<int>(sample.mesh.V.cols()));
  }
}

/// States near rest and far from it.
inline std::vector<Unknowns> states(const Unknowns& rest) {
  return {rest, perturbed(rest, 0.1, 2), perturbed(rest, 3, 3)};
}
inline std::vector<Unknowns> states(const Sample& sample) { return states(sample.rest()); }

inline std::vector<const double*> pointers(const Energy& energy, const Unknowns& x, int e) {
  std::vector<const double*> result;
  for (const int node : energy.nodes(e)) result.push_back(x.node(node));
  return result;
}

/// All residuals and all Jacobians. An entry that the term does not write stays NaN.
inline Eigen::VectorXd residuals(const Energy& energy, const Unknowns& x) {
  Eigen::VectorXd r = Eigen::VectorXd::Constant(energy.rows() * energy.size(), NAN);
  energy.residuals(x, r.data());
  return r;
}
inline Eigen::MatrixXd jacobians(const Energy& energy, const Unknowns& x) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Constant(
      energy.rows(), std::ptrdiff_t(energy.jacobian_columns()) * energy.size(), NAN);
  energy.jacobians(x, J.data());
  return J;
}

/// The Jacobian of one element by central differences.
inline Eigen::MatrixXd differences(const Energy& energy, const Unknowns& x, int e) {
  constexpr double h = 1e-5;
  Eigen::MatrixXd J(energy.rows(), energy.jacobian_columns());
  for (int a = 0, column = 0; a < energy.arity(); ++a) {
    const int first = x.first[energy.nodes(e)[a]] * x.dimension();
    for (int i = 0; i < x.dimension() * energy.argument(a).count; ++i) {
      Unknowns up = x, down = x;
      up.X.reshaped()[first + i] += h;
      down.X.reshaped()[first + i] -= h;
      Eigen::VectorXd r_up(energy.rows()), r_down(energy.rows());
      energy.evaluate(e, pointers(energy, up, e).data(), r_up.data(), nullptr);
      energy.evaluate(e, pointers(energy, down, e).data(), r_down.data(), nullptr);
      J.col(column++) = (r_up - r_down) / (2 * h);
    }
  }
  return J;
}

/// Automatic differentiation, the term's own derivative if it has one, and differences agree.
template <class Term>
AssertionResult derivatives_agree(Terms<Term> sum, const Unknowns& x) {
  std::fill(sum.weights.begin(), sum.weights.end(), 1);  // which jets() does not apply
  const TermEnergy<Term> energy(std::move(sum));
  const Eigen::MatrixXd J = jacobians(energy, x);
  const int width = energy.jacobian_columns();
  for (int e = 0; e < energy.size(); ++e) {
    const auto declared = J.middleCols(std::ptrdiff_t(e) * width, width);
    Eigen::MatrixXd jet(energy.rows(), width);
    energy.jets(e, pointers(energy, x, e).data(), jet);
    const double size = 1 + jet.cwiseAbs().maxCoeff();
    const double from_jets = (declared - jet).cwiseAbs().maxCoeff() / size;
    const double measured = (jet - differences(energy, x, e)).cwiseAbs().maxCoeff() / size;
    if (!(from_jets < 1e-13)) return AssertionFailure() << "jacobian − jets = " << from_jets;
    if (!(measured < 1e-7)) return AssertionFailure() << "jets − differences = " << measured;
  }
  return AssertionSuccess();
}

inline AssertionResult zero_at_rest(const Energy& energy, const Unknowns& rest) {
  const double largest = residuals(energy, rest).cwiseAbs().maxCoeff();
  if (largest < 1e-12) return AssertionSuccess();
  return AssertionFailure() << "a residual at rest is " << largest;
}

/// x after a rigid motion p → Q p + c of all space. The nodes of x are vertices (one column), rigid
/// nodes (two columns), or affine ones.
inline Unknowns moved(Unknowns x, const Eigen::Matrix3Xd& nodes, const Eigen::MatrixXd& Q,
                      const Eigen::VectorXd& c) {
  const int d = x.dimension();
  for (int j = 0; j < x.nodes(); ++j) {
    auto node = x.X.middleCols(x.first[j], x.columns(j));
    Eigen::VectorXd g = Eigen::VectorXd::Zero(d);
    if (x.columns(j) > 1) g = nodes.col(j).head(d);
    if (x.columns(j) == 2) {
      const Eigen::Vector3d omega = node.col(0);
      const Eigen::AngleAxisd turn(
          Eigen::Matrix3d(Q * Eigen::AngleAxisd(omega.norm(), omega.stableNormalized()).matrix()));
      node.col(0) = turn.angle() * turn.axis();
      node.col(1) = (Q * node.col(1)).eval();
    } else {
      node = (Q * node).eval();
    }
    node.rightCols<1>() += Q * g + c - g;
  }
  return x;
}

inline AssertionResult rigidly_invariant(const Energy& energy, const Sample& sample,
                                         const Unknowns& x) {
  const Eigen::Matrix3d Q3 = Eigen::Quaterniond(0.3, -0.5, 0.2, 0.8).normalized().matrix();
  const Eigen::Matrix2d Q2 = Eigen::Rotation2Dd(2.1).matrix();
  const int d = x.dimension();
  const Eigen::MatrixXd Q = d == 2 ? Eigen::MatrixXd(Q2) : Eigen::MatrixXd(Q3);
  const double before = residuals(energy, x).squaredNorm();
  const Unknowns there = moved(x, sample.graph.g, Q, Eigen::Vector3d(0.7, -2, 1.1).head(d));
  const double after = residuals(energy, there).squaredNorm();
  if (std::abs(after - before) <= 1e-11 * (1 + before)) return AssertionSuccess();
  return AssertionFailure() << "E is " << before << ", after a rigid motion " << after;
}

/// Whether J = aᵀ ⊗ I_d in every block.
inline bool is_kronecker(const Energy& energy, const Eigen::MatrixXd& J) {
  const int d = energy.dimension();
  if (energy.rows() != d) return false;
  for (Eigen::Index c = 0; c < J.cols(); c += d) {
    const auto block = J.middleCols(c, d);
    const Eigen::MatrixXd expected = block(0, 0) * Eigen::MatrixXd::Identity(d, d);
    if ((block - expected).cwiseAbs().maxCoeff() > 1e-14) return false;
  }
  return true;
}

/// r = X a − b with the a and b that a Kronecker term gives.
inline AssertionResult has_its_coefficients(const Energy& energy, const Unknowns& x) {
  const int d = energy.dimension();
  Eigen::MatrixXd a(energy.jacobian_columns() / d, energy.size()), b(d, energy.size());
  energy.coefficients(a.data());
  energy.offsets(b.data());
  Eigen::MatrixXd r = -b;
  for (int e = 0; e < energy.size(); ++e) {
    int c = 0;
    for (int i = 0; i < energy.arity(); ++i) {
      for (int k = 0; k < energy.argument(i).count; ++k) {
        r.col(e) += a(c++, e) * x.X.col(x.first[energy.nodes(e)[i]] + k);
      }
    }
  }
  if (relative_difference(r.reshaped(), residuals(energy, x)) <= 1e-12) return AssertionSuccess();
  return AssertionFailure() << "r is not X a − b";
}

/// The declared structure is that of two states, and no stronger one could be declared.
inline AssertionResult has_declared_structure(const Energy& energy, const Unknowns& x,
                                              const Unknowns& y) {
  const Eigen::MatrixXd J = jacobians(energy, x);
  const bool constant = (J - jacobians(energy, y)).cwiseAbs().maxCoeff() <= 1e-14;
  if (energy.structure() == Structure::kNonlinear) {
    if (!constant) return AssertionSuccess();
    return AssertionFailure() << "declared nonlinear, but J is constant";
  }
  if (!constant) return AssertionFailure() << "J is not constant";
  const SparseSystem at_x = sparse_system({{&energy}}, x), at_y = sparse_system({{&energy}}, y);
  const Eigen::VectorXd predicted = at_x.r + at_x.J * (y.X - x.X).reshaped();
  if (relative_difference(predicted, at_y.r) > 1e-12) {
    return AssertionFailure() << "r is not affine in X";
  }
  const bool Kronecker = is_kronecker(energy, J);
  if (Kronecker == (energy.structure() == Structure::kKronecker)) {
    return Kronecker ? has_its_coefficients(energy, y) : AssertionSuccess();
  }
  return AssertionFailure() << (Kronecker ? "Kronecker, but declared linear" : "not Kronecker");
}

template <class Term>
Terms<Term> shuffled(const Terms<Term>& sum) {
  std::vector<int> order(sum.elements.size());
  for (int i = 0; i < std::ssize(order); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937_64(5));
  const int arity = static_cast<int>(sum.nodes.size() / sum.elements.size());
  Terms<Term> result{.arity = sum.arity};
  for (const int e : order) {
    result.add(sum.elements[e], std::span(sum.nodes).subspan(std::size_t(e) * arity, arity),
               sum.weights[e]);
  }
  return result;
}

template <class Term>
AssertionResult order_does_not_matter(const Terms<Term>& sum, const Unknowns& x) {
  const TermEnergy<Term> one(sum), other(shuffled(sum));
  const SparseSystem a = sparse_system({{&one}}, x), b = sparse_system({{&other}}, x);
  if (relative_difference(a.JtJ(), b.JtJ()) < 1e-13 &&
      relative_difference(a.Jtr(), b.Jtr()) < 1e-12 &&
      std::abs(a.r.squaredNorm() - b.r.squaredNorm()) <= 1e-13 * a.r.squaredNorm()) {
    return AssertionSuccess();
  }
  return AssertionFailure() << "another order of elements gives another E, JᵀJ or Jᵀr";
}

/// Every entry is written, and with a finite number.
inline AssertionResult all_written_and_finite(const Energy& energy, const Unknowns& x) {
  if (!residuals(energy, x).allFinite()) return AssertionFailure() << "a residual is not finite";
  if (!jacobians(energy, x).allFinite()) return AssertionFailure() << "a derivative is not finite";
  return AssertionSuccess();
}

/// An element of weight α has residuals √α times those of weight 1, and so has its Jacobian.
template <class Term>
AssertionResult weights_scale(Terms<Term> sum, const Unknowns& x) {
  std::fill(sum.weights.begin(), sum.weights.end(), 1);
  const TermEnergy<Term> plain(sum);
  for (int e = 0; e < std::ssize(sum.weights); ++e) sum.weights[e] = 0.25 * (1 + e % 7);
  const TermEnergy<Term> weighted(sum);
  const Eigen::VectorXd r = residuals(plain, x), s = residuals(weighted, x);
  const Eigen::MatrixXd J = jacobians(plain, x), K = jacobians(weighted, x);
  const int rows = plain.rows(), width = plain.jacobian_columns();
  for (int e = 0; e < plain.size(); ++e) {
    const double root = std::sqrt(sum.weights[e]);
    const std::ptrdiff_t c = std::ptrdiff_t(e) * width;
    if (!s.segment(e * rows, rows).isApprox(root * r.segment(e * rows, rows), 1e-14) ||
        !K.middleCols(c, width).isApprox(root * J.middleCols(c, width), 1e-14)) {
      return AssertionFailure() << "element " << e << " does not scale with its weight";
    }
  }
  return AssertionSuccess();
}

inline AssertionResult is_lower_snake_case(std::string_view name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (!name.empty() && name[0] >= 'a' && name[0] <= 'z' && name.back() != '_' &&
      std::all_of(name.begin(), name.end(), allowed)) {
    return AssertionSuccess();
  }
  return AssertionFailure() << "'" << name << "' is not a name in lower_snake_case";
}

}  // namespace deformlab::test
