#include "solvers/stage.h"

#include <string>

#include "geometry/error.h"

namespace deformlab {
namespace {

bool fits(const Energy& energy, const Unknowns& x) {
  if (energy.dimension() != x.dimension()) return false;
  const std::span<const int> nodes = energy.nodes();
  const int arity = energy.arity();
  for (int a = 0; a < arity; ++a) {
    const int count = energy.argument(a).count;
    for (std::size_t i = a; i < nodes.size(); i += arity) {
      if (nodes[i] < 0 || nodes[i] >= x.nodes() || count > x.columns(nodes[i])) return false;
    }
  }
  return true;
}

}  // namespace

void check(const Stage& stage) {
  for (const auto& [energy, weight] : stage.terms) {
    if (fits(*energy, stage.x)) continue;
    throw InputError("the term '" + std::string(energy->name()) +
                     "' reads nodes that this problem does not have: check the node indices, the "
                     "dimension and the columns of its arguments");
  }
}

double cost(const Stage& stage, const Unknowns& x) {
  double sum = 0;
  for (const auto& [energy, weight] : stage.terms) {
    Eigen::VectorXd r(energy->rows() * energy->size());
    energy->residuals(x, r.data());
    sum += weight * r.squaredNorm();
  }
  return sum;
}

}  // namespace deformlab
