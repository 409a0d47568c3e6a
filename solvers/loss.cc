#include "solvers/loss.h"

#include <ceres/loss_function.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace deformlab {
std::shared_ptr<const ceres::LossFunction> make_loss(const LossOptions& options) {
  check_options(options);
  switch (options.kind) {
    case LossKind::kNone:
      break;
    case LossKind::kHuber:
      return std::make_shared<ceres::HuberLoss>(options.scale);
    case LossKind::kCauchy:
      return std::make_shared<ceres::CauchyLoss>(options.scale);
    case LossKind::kTukey:
      return std::make_shared<ceres::TukeyLoss>(options.scale);
  }
  return nullptr;
}

double squared_sum(const Eigen::MatrixXd& r, const ceres::LossFunction* loss) {
  if (loss == nullptr) return r.squaredNorm();
  double total = 0;
  std::array<double, 3> rho;  // ρ, ρ′, ρ″
  for (Eigen::Index e = 0; e < r.cols(); ++e) {
    const double s = r.col(e).squaredNorm();
    loss->Evaluate(s, rho.data());
    total += std::isfinite(s) ? rho[0] : s;  // Tukey's loss takes NaN for a far outlier
  }
  return total;
}

double loss_slope(const ceres::LossFunction& loss, double squared_norm) {
  std::array<double, 3> rho;
  loss.Evaluate(squared_norm, rho.data());
  return std::max(0.0, rho[1]);
}

}  // namespace deformlab
