#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

#include "geometry/core/options.h"

namespace ceres {
class LossFunction;
}

namespace deformlab {

/// ρ of a robust term, F = Σ w Σ_e ρ(‖r_e‖²), with which elements whose residual
/// stays large count for less than its square. With a the scale and s = ‖r‖²:
///   huber   s up to a², then 2a‖r‖ − a²: convex
///   cauchy  a² log(1 + s/a²): what is far away pulls ever less
///   tukey   a²/3 (1 − (1 − s/a²)³), then a²/3: beyond a nothing pulls at all
/// The last two are not convex. Handles whose targets are many a away may stay where they are. A
/// greater a, or a drag in smaller steps, then helps.
enum class LossKind { kNone, kHuber, kCauchy, kTukey };
constexpr auto names_of(LossKind) {
  using enum LossKind;
  return std::to_array<EnumName<LossKind>>(
      {{kNone, "none"}, {kHuber, "huber"}, {kCauchy, "cauchy"}, {kTukey, "tukey"}});
}

/// The loss of one energy term.
struct LossOptions {
  LossKind kind = LossKind::kNone;
  double scale = 1;  ///< a, in the unit of the residual: for lengths, the energy's own unit

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("kind", o.kind, "The robust loss of the term");
    // Beyond this range a² swallows what is added to it.
    visit.range("scale", o.scale, {.min = 1e-6, .max = 1e3},
                "The size of a residual above which the loss pulls less than its square "
                "[length_unit]");
  }
};

/// The loss, null for "none". Throws OptionError for a scale out of range.
std::shared_ptr<const ceres::LossFunction> make_loss(const LossOptions& options);

/// Σ_e ρ(‖r_e‖²) of residuals, rows × elements; ρ(s) = s where there is no loss.
double squared_sum(const Eigen::MatrixXd& r, const ceres::LossFunction* loss);

/// ρ′(‖r‖²) of one element.
double loss_slope(const ceres::LossFunction& loss, double squared_norm);

}  // namespace deformlab
