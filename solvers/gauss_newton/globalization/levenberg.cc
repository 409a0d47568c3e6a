#include "solvers/gauss_newton/globalization/levenberg.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace deformlab {
namespace {

constexpr double kFirstDamping = 1e-4, kLeastDamping = 1e-16, kMostDamping = 1e16;

}  // namespace

void Levenberg::start(int) {
  damping_ = kFirstDamping;
  growth_ = 2;
}

Outcome Levenberg::advance(Iterate& iterate, Iteration& step) {
  while (damping_ < kMostDamping) {
    step.damping = damping_;
    double promised = 0;
    step.cost = std::numeric_limits<double>::infinity();
    if (iterate.compute_direction(damping_)) {
      iterate.set_direction();
      step.cost = iterate.try_step(1);
      const Eigen::VectorXd& delta = iterate.delta();
      promised =
          damping_ * delta.dot(iterate.D().cwiseProduct(delta)) - delta.dot(iterate.gradient());
    }
    const double fell = iterate.cost() - step.cost;
    if (fell >= -iterate.rounding()) {
      const double ratio = promised > 0 ? std::max(0.0, fell / promised) : 1;
      const double factor = std::max(1.0 / 3, 1 - std::pow(2 * ratio - 1, 3));
      damping_ = std::max(kLeastDamping, damping_ * factor);
      growth_ = 2;
      return Outcome::kAccepted;
    }
    damping_ *= growth_;
    growth_ *= 2;
  }
  return Outcome::kUphill;
}

}  // namespace deformlab
