#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

#include "geometry/core/options.h"

namespace ceres {
class LossFunction;
}

namespace deformlab {

/// The loss ρ of a robust term, which contributes w Σ_e ρ(‖r_e‖²) to F. It reduces the influence of
/// elements whose residual cannot become small. With the scale a and s = ‖r‖²:
///   huber   s if s ≤ a², else 2a‖r‖ − a². It is convex.
///   cauchy  a² log(1 + s/a²). The influence decreases for large residuals.
///   tukey   a²/3 (1 − (1 − s/a²)³) if s ≤ a², else a²/3. Residuals above a have no influence.
/// cauchy and tukey are not convex: a handle that starts many times a away from its target may stay
/// there. Then a greater a, or a drag in smaller steps, helps.
enum class LossKind { kNone, kHuber, kCauchy, kTukey };
constexpr auto names_of(LossKind) {
  using enum LossKind;
  return std::to_array<EnumName<LossKind>>(
      {{kNone, "none"}, {kHuber, "huber"}, {kCauchy, "cauchy"}, {kTukey, "tukey"}});
}

/// The loss of one energy term.
struct LossOptions {
  LossKind kind = LossKind::kNone;
  double scale = 1;  ///< a, in the unit of the residual; lengths are in the problem's unit

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("kind", o.kind, "The robust loss of the term");
    // Outside this range, sums with a² lose too many digits.
    visit.range("scale", o.scale, {.min = 1e-6, .max = 1e3},
                "The size of a residual above which the loss pulls less than its square "
                "[length_unit]");
  }
};

/// The loss, null for "none". Throws OptionError for a scale out of range.
std::shared_ptr<const ceres::LossFunction> make_loss(const LossOptions& options);

/// Σ_e ρ(‖r_e‖²) of the residuals r, rows × elements. Without a loss, ρ(s) = s.
double squared_sum(const Eigen::MatrixXd& r, const ceres::LossFunction* loss);

/// ρ′(‖r‖²) of one element.
double loss_slope(const ceres::LossFunction& loss, double squared_norm);

}  // namespace deformlab
