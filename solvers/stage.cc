#include "solvers/stage.h"

#include <string>

#include "geometry/error.h"

namespace deformlab {
namespace {

bool fits(const Energy& energy, const Unknowns& x) {
  if (energy.dimension() != x.dimension()) return false;
  for (int e = 0; e < energy.size(); ++e) {
    for (int a = 0; a < energy.arity(); ++a) {
      const int node = energy.nodes(e)[a];
      if (node < 0 || node >= x.nodes() || energy.argument(a).count > x.columns(node)) return false;
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
