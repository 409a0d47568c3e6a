#include "solvers/gauss_newton/globalization/accelerated.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/gauss_newton/globalization/line_search.h"

namespace deformlab {
namespace {

// A step shorter than kShort increases the damping of the next direction to at least kShortDamping,
// and a step longer than kLong decreases it.
constexpr double kShort = 0.25, kLong = 0.75, kShortDamping = 1e-3;
// If F falls by less than this share of what was promised, geodesic acceleration is tried.
constexpr double kPoor = 0.25;
// A direction is made conjugate if β is less than kMostConjugate, and if the result still has at
// least kDescent of the slope.
constexpr double kMostConjugate = 5, kDescent = 0.1;
constexpr int kMostLengths = 4;      // lengths that are tried along one direction
constexpr double kSameLength = 0.1;  // a length with a smaller relative change is not tried
constexpr double kMostLength = 4;    // interpolated lengths are no less than a tenth of the last

}  // namespace

void Accelerated::start(int unknowns) {
  damping_ = 0;
  conjugate_ = false;
  geodesic_ = true;
  for (Eigen::VectorXd* x :
       {&newton_, &gradient_, &last_newton_, &last_gradient_, &last_delta_, &correction_}) {
    x->resize(unknowns);
  }
}

// Where plain Gauss–Newton steps converge at a constant rate, conjugate directions are faster.
void Accelerated::make_conjugate(Iterate& iterate) {
  Eigen::VectorXd& delta = iterate.delta();
  newton_ = delta;
  gradient_ = iterate.gradient();
  const double slope = gradient_.dot(newton_);
  if (conjugate_) {
    const double before = last_gradient_.dot(last_newton_);
    const double beta = (slope - last_gradient_.dot(newton_)) / before;
    if (beta > 0 && beta < kMostConjugate) {
      delta += beta * last_delta_;
      if (gradient_.dot(delta) > kDescent * slope) delta = newton_;  // slopes are negative
    }
  }
  last_newton_.swap(newton_);
  last_gradient_.swap(gradient_);
  conjugate_ = true;
}

void Accelerated::find_length(Iterate& iterate, double slope, Iteration& step) const {
  double scale = 1;
  step.cost = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostLengths; ++i) {
    const double there = iterate.try_step(scale);
    if (there < step.cost) step.cost = there, step.step_scale = scale;
    const double curvature = there - iterate.cost() - scale * slope;  // F″ along δ · scale² / 2
    double next = scale / 2;
    if (std::isfinite(there)) {
      if (!(curvature > iterate.rounding())) break;
      next = std::clamp(-slope * scale * scale / (2 * curvature), scale / 10, kMostLength);
    }
    if (std::abs(next - scale) < kSameLength * scale) break;
    scale = next;
  }
}

// Tries the full step with geodesic acceleration, and takes it if F is less there than at the best
// point along δ. Otherwise it restores δ, and there is no trial point.
bool Accelerated::try_geodesic_step(Iterate& iterate, Iteration& step) {
  if (!std::isfinite(iterate.try_step(1))) return false;
  if (!iterate.compute_geodesic_correction(correction_)) return false;
  iterate.delta() += correction_;
  iterate.set_direction();
  const double there = iterate.try_step(1);
  geodesic_ = there < step.cost;
  if (geodesic_) {
    step.cost = there;
    step.step_scale = 1;
    return true;
  }
  iterate.delta() -= correction_;
  iterate.set_direction();
  iterate.forget_trial();
  return false;
}

void Accelerated::adapt_damping(double length) {
  if (length < kShort) damping_ = std::max(kShortDamping, 4 * damping_);
  if (length > kLong) damping_ = damping_ > kShortDamping / 8 ? damping_ / 4 : 0;
}

Outcome Accelerated::advance(Iterate& iterate, Iteration& step) {
  step.damping = damping_;
  if (!iterate.compute_regular_direction(damping_)) return Outcome::kSingular;
  make_conjugate(iterate);
  iterate.set_direction();
  const double slope = iterate.slope();
  find_length(iterate, slope, step);
  const double promised = -slope / 2;
  const bool poor = !(iterate.cost() - step.cost > kPoor * promised);
  adapt_damping(step.step_scale);
  if (geodesic_ && poor && promised > iterate.rounding() && try_geodesic_step(iterate, step)) {
    conjugate_ = false;
    return Outcome::kAccepted;
  }
  last_delta_ = iterate.delta();
  while (!iterate.sufficient(step.cost, step.step_scale, slope)) {
    step.step_scale /= 2;
    if (step.step_scale < LineSearch::kSmallestStep) return Outcome::kUphill;
    step.cost = iterate.try_step(step.step_scale);
  }
  if (iterate.tried() != step.step_scale) iterate.try_step(step.step_scale);
  return Outcome::kAccepted;
}

}  // namespace deformlab
