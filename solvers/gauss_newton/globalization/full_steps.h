#pragma once

#include <cmath>

#include "solvers/gauss_newton/globalization/globalization.h"

namespace deformlab {

/// Full Gauss–Newton steps, as in Sumner et al. 2007. They can increase F.
class FullSteps final : public Globalization {
 public:
  Outcome advance(Iterate& iterate, Iteration& step) override {
    if (!iterate.compute_regular_direction(0)) return Outcome::kSingular;
    iterate.set_direction();
    step.cost = iterate.try_step(1);
    return std::isfinite(step.cost) ? Outcome::kAccepted : Outcome::kNotFinite;
  }
};

}  // namespace deformlab
