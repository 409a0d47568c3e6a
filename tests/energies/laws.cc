#include "tests/energies/laws.h"

#include <Eigen/Geometry>
#include <cmath>

namespace deformlab::test {

std::vector<Unknowns> states(const Unknowns& rest) {
  return {rest, perturbed(rest, 0.1, 2), perturbed(rest, 3, 3)};
}

std::vector<Unknowns> states(const Sample& sample) { return states(sample.rest()); }

std::vector<const double*> pointers(const Energy& energy, const Unknowns& x, int e) {
  std::vector<const double*> result;
  for (const int node : energy.nodes(e)) result.push_back(x.node(node));
  return result;
}

Eigen::VectorXd residuals(const Energy& energy, const Unknowns& x) {
  Eigen::VectorXd r = Eigen::VectorXd::Constant(energy.rows() * energy.size(), NAN);
  energy.residuals(x, r.data());
  return r;
}

Eigen::MatrixXd jacobians(const Energy& energy, const Unknowns& x) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Constant(
      energy.rows(), std::ptrdiff_t(energy.jacobian_columns()) * energy.size(), NAN);
  energy.jacobians(x, J.data());
  return J;
}

Eigen::MatrixXd differences(const Energy& energy, const Unknowns& x, int e) {
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

AssertionResult derivatives_agree(const Energy& energy, const Unknowns& x, const Jets& jets) {
  const Eigen::MatrixXd J = jacobians(energy, x);
  const int width = energy.jacobian_columns();
  for (int e = 0; e < energy.size(); ++e) {
    const auto declared = J.middleCols(std::ptrdiff_t(e) * width, width);
    Eigen::MatrixXd jet(energy.rows(), width);
    jets(e, pointers(energy, x, e).data(), jet);
    const double size = 1 + jet.cwiseAbs().maxCoeff();
    const double from_jets = (declared - jet).cwiseAbs().maxCoeff() / size;
    const double measured = (jet - differences(energy, x, e)).cwiseAbs().maxCoeff() / size;
    if (!(from_jets < 1e-13)) return AssertionFailure() << "jacobian − jets = " << from_jets;
    if (!(measured < 1e-7)) return AssertionFailure() << "jets − differences = " << measured;
  }
  return AssertionSuccess();
}

AssertionResult zero_at_rest(const Energy& energy, const Unknowns& rest) {
  const double largest = residuals(energy, rest).cwiseAbs().maxCoeff();
  if (largest < 1e-12) return AssertionSuccess();
  return AssertionFailure() << "a residual at rest is " << largest;
}

Unknowns moved(Unknowns x, const Eigen::Matrix3Xd& nodes, const Eigen::MatrixXd& Q,
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

AssertionResult rigidly_invariant(const Energy& energy, const Sample& sample, const Unknowns& x) {
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

bool is_kronecker(const Energy& energy, const Eigen::MatrixXd& J) {
  const int d = energy.dimension();
  if (energy.rows() != d) return false;
  for (Eigen::Index c = 0; c < J.cols(); c += d) {
    const auto block = J.middleCols(c, d);
    const Eigen::MatrixXd expected = block(0, 0) * Eigen::MatrixXd::Identity(d, d);
    if ((block - expected).cwiseAbs().maxCoeff() > 1e-14) return false;
  }
  return true;
}

AssertionResult has_its_coefficients(const Energy& energy, const Unknowns& x) {
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

AssertionResult has_declared_structure(const Energy& energy, const Unknowns& x, const Unknowns& y) {
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
  const bool kronecker = is_kronecker(energy, J);
  if (kronecker == (energy.structure() == Structure::kKronecker)) {
    return kronecker ? has_its_coefficients(energy, y) : AssertionSuccess();
  }
  return AssertionFailure() << (kronecker ? "Kronecker, but declared linear" : "not Kronecker");
}

AssertionResult agree(const Energy& one, const Energy& other, const Unknowns& x) {
  const SparseSystem a = sparse_system({{&one}}, x), b = sparse_system({{&other}}, x);
  if (relative_difference(a.JtJ(), b.JtJ()) < 1e-13 &&
      relative_difference(a.Jtr(), b.Jtr()) < 1e-12 &&
      std::abs(a.r.squaredNorm() - b.r.squaredNorm()) <= 1e-13 * a.r.squaredNorm()) {
    return AssertionSuccess();
  }
  return AssertionFailure() << "another order of elements gives another E, JᵀJ or Jᵀr";
}

AssertionResult all_written_and_finite(const Energy& energy, const Unknowns& x) {
  if (!residuals(energy, x).allFinite()) return AssertionFailure() << "a residual is not finite";
  if (!jacobians(energy, x).allFinite()) return AssertionFailure() << "a derivative is not finite";
  return AssertionSuccess();
}

AssertionResult scales(const Energy& plain, const Energy& weighted,
                       const std::vector<double>& weights, const Unknowns& x) {
  const Eigen::VectorXd r = residuals(plain, x), s = residuals(weighted, x);
  const Eigen::MatrixXd J = jacobians(plain, x), K = jacobians(weighted, x);
  const int rows = plain.rows(), width = plain.jacobian_columns();
  for (int e = 0; e < plain.size(); ++e) {
    const double root = std::sqrt(weights[e]);
    const std::ptrdiff_t c = std::ptrdiff_t(e) * width;
    if (!s.segment(e * rows, rows).isApprox(root * r.segment(e * rows, rows), 1e-14) ||
        !K.middleCols(c, width).isApprox(root * J.middleCols(c, width), 1e-14)) {
      return AssertionFailure() << "element " << e << " does not scale with its weight";
    }
  }
  return AssertionSuccess();
}

AssertionResult is_lower_snake_case(std::string_view name) {
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
