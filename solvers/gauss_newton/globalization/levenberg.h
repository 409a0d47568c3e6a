#pragma once

#include "solvers/gauss_newton/globalization/globalization.h"

namespace deformlab {

/// Steps damped by λ diag(JᵀJ), as in the method of Levenberg and Marquardt. λ follows the ratio of
/// how much F fell to how much the linear model promised (Nielsen's rule, in Madsen, Nielsen and
/// Tingleff 2004, section 3.2).
class Levenberg final : public Globalization {
 public:
  void start(int unknowns) override;
  Outcome advance(Iterate& iterate, Iteration& step) override;

 private:
  double damping_ = 0, growth_ = 2;
};

}  // namespace deformlab
