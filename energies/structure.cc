#include "energies/structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <vector>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr int kElements = 8;         // elements that are evaluated, spread over the term
constexpr double kTolerance = 1e-9;  // relative; rounding errors are much smaller
// For a shape far from the origin, residuals are small differences of large coordinates. States of
// this size are large compared with their rounding errors, and show a nonlinearity too.
constexpr double kFarState = 1e6;

// One element at one state, whose entries are drawn from −scale … scale.
struct Sample {
  Eigen::VectorXd x, r;
  Eigen::MatrixXd J;

  Sample(const Energy& energy, int e, std::minstd_rand& random, double scale = 1)
      : x(energy.jacobian_columns()), r(energy.rows()), J(r.size(), x.size()) {
    std::uniform_real_distribution<double> entry(-scale, scale);
    for (double& value : x) value = entry(random);
    std::vector<const double*> nodes;
    for (int a = 0, first = 0; a < energy.arity(); ++a) {
      nodes.push_back(x.data() + first);
      first += energy.dimension() * energy.argument(a).count;
    }
    energy.evaluate(e, nodes.data(), r.data(), J.data());
  }
  bool finite() const { return r.allFinite() && J.allFinite(); }
};

// Returns false if a value is not finite, because no comparison with it holds.
bool is_affine(const Sample& a, const Sample& b) {
  const Eigen::VectorXd step = b.x - a.x;
  const double size = a.r.norm() + b.r.norm() + a.J.norm() * step.norm();
  return (a.J - b.J).norm() <= kTolerance * (a.J.norm() + b.J.norm()) &&
         (a.r + a.J * step - b.r).norm() <= kTolerance * size;
}

bool is_kronecker(const Eigen::MatrixXd& J, int d) {
  if (J.rows() != d) return false;
  double off = 0;
  for (Eigen::Index c = 0; c < J.cols(); c += d) {
    const auto block = J.middleCols(c, d);
    off = std::max(off, (block - block(0, 0) * Eigen::MatrixXd::Identity(d, d)).norm());
  }
  return off <= kTolerance * J.norm();
}

}  // namespace

void check_structure(const Energy& energy) {
  const bool kronecker = energy.structure() == Structure::kKronecker;
  if (energy.structure() == Structure::kNonlinear) return;
  std::minstd_rand random(1);
  const int count = std::min(energy.size(), kElements);
  for (int i = 0; i < count; ++i) {
    const int e = static_cast<int>(std::int64_t(energy.size()) * i / count);
    const Sample a(energy, e, random), b(energy, e, random);
    if (!a.finite() || !b.finite()) continue;  // the solver reports this
    if (!is_affine(a, b) &&
        !is_affine({energy, e, random, kFarState}, {energy, e, random, kFarState})) {
      throw InputError(fmt::format(
          "the term '{}' declares its structure as {}, but the residual of its element {} is not "
          "linear in the unknowns, or its derivative is wrong; declare Structure::kNonlinear, or "
          "correct the derivative",
          energy.name(), kronecker ? "Kronecker" : "linear", e));
    }
    if (kronecker && !is_kronecker(a.J, energy.dimension())) {
      throw InputError(
          fmt::format("the term '{}' declares its structure as Kronecker, but the Jacobian of its "
                      "element {} is "
                      "not the same for every coordinate; declare Structure::kLinear",
                      energy.name(), e));
    }
  }
}

}  // namespace deformlab
