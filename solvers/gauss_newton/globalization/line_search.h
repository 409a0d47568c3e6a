#pragma once

#include "solvers/gauss_newton/globalization/globalization.h"

namespace deformlab {

/// Gauss–Newton steps that are halved until F falls enough (Armijo's rule).
class LineSearch final : public Globalization {
 public:
  static constexpr double kSmallestStep = 1e-6;

  Outcome advance(Iterate& iterate, Iteration& step) override {
    if (!iterate.compute_regular_direction(0)) return Outcome::kSingular;
    iterate.set_direction();
    const double slope = iterate.slope();
    for (double scale = 1; scale >= kSmallestStep; scale /= 2) {
      step.cost = iterate.try_step(scale);
      step.step_scale = scale;
      if (iterate.sufficient(step.cost, scale, slope)) return Outcome::kAccepted;
    }
    return Outcome::kUphill;
  }
};

}  // namespace deformlab
