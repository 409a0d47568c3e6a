#include "solvers/loss.h"

#include <ceres/loss_function.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

// Beyond, a² swallows what is added to it.
constexpr double kLeastScale = 1e-6, kMostScale = 1e3;

}  // namespace

std::shared_ptr<const ceres::LossFunction> make_loss(const LossOptions& options,
                                                     const std::string& name) {
  const double a = options.scale;
  if (!(a >= kLeastScale && a <= kMostScale)) {
    std::ostringstream message;
    message << name << ".scale is " << a << "; it lies between " << kLeastScale << " and "
            << kMostScale << ", in length_units; for no loss set " << name << ".kind: none";
    throw InputError(message.str());
  }
  if (options.kind == "none") return nullptr;
  if (options.kind == "huber") return std::make_shared<ceres::HuberLoss>(a);
  if (options.kind == "cauchy") return std::make_shared<ceres::CauchyLoss>(a);
  if (options.kind == "tukey") return std::make_shared<ceres::TukeyLoss>(a);
  throw InputError("unknown " + name + ".kind '" + options.kind +
                   "'; known: none, huber, cauchy, tukey");
}

double squared_sum(const Eigen::MatrixXd& r, const ceres::LossFunction* loss) {
  if (loss == nullptr) return r.squaredNorm();
  double total = 0;
  std::array<double, 3> rho;  // ρ, ρ′, ρ″
  for (Eigen::Index e = 0; e < r.cols(); ++e) {
    loss->Evaluate(r.col(e).squaredNorm(), rho.data());
    total += rho[0];
  }
  return total;
}

double loss_slope(const ceres::LossFunction& loss, double squared_norm) {
  std::array<double, 3> rho;
  loss.Evaluate(squared_norm, rho.data());
  return std::max(0.0, rho[1]);
}

}  // namespace deformlab
