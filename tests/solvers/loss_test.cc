#include "solvers/loss.h"

#include <gtest/gtest.h>

#include "geometry/core/error.h"
#include "tests/solvers/ladder.h"

namespace deformlab::test {
namespace {

constexpr double kTight = 1e-12;
constexpr LossKind kKinds[] = {LossKind::kHuber, LossKind::kCauchy, LossKind::kTukey};

// The twisted plate; the target of every so manyth handle is several edges away from where it
// should be.
Problem with_outliers(int m, const LossOptions& loss, int every = 7) {
  const Sample sample = random_sample(m);
  Eigen::Matrix3Xd targets = twisted(sample.handles, 0.4, 0.3);
  for (Eigen::Index l = 0; l < targets.cols(); l += every) {
    targets.col(l) += Eigen::Vector3d(0.5, -1, 3);
  }
  Problem problem = make_problem(sample, targets);
  term(problem, "constraint").loss = make_loss(loss);
  return problem;
}

class Loss : public ::testing::TestWithParam<LossKind> {};

TEST_P(Loss, IsTheSquareOfSmallResidualsAndGrowsLess) {
  const auto loss = make_loss({GetParam(), 0.5});
  const auto rho = [&](double s) {
    return squared_sum(Eigen::MatrixXd::Constant(1, 1, std::sqrt(s)), loss.get());
  };
  EXPECT_EQ(rho(0), 0);
  EXPECT_NEAR(rho(1e-6), 1e-6, 1e-11);
  for (const double s : {0.01, 0.2, 0.3, 1.0, 10.0}) {
    const double h = 1e-6 * s, difference = (rho(s + h) - rho(s - h)) / (2 * h);
    EXPECT_NEAR(loss_slope(*loss, s), difference, 1e-7) << s;
    EXPECT_LE(rho(s), s * (1 + 1e-12)) << s;
    EXPECT_LE(loss_slope(*loss, 2 * s), loss_slope(*loss, s)) << s;
  }
}

TEST_P(Loss, Rung1ResidualsAndDerivativesAgree) {
  Problem problem = with_outliers(60, {GetParam(), 0.3});
  expect_same_system(problem, perturbed(problem.x, 0.1));
  for (const char* name : {"rotation", "regularization"}) {
    term(problem, name).loss = make_loss({GetParam(), 0.7});
  }
  for (int j = 0; j < problem.x.nodes(); j += 4) problem.fixed[j] = 1;
  expect_same_system(problem, perturbed(problem.x, 0.3));
}

TEST_P(Loss, Rung2TheDenseStepIsTaken) {
  Problem problem = with_outliers(40, {GetParam(), 2});
  for (const char* name : {"cholmod", "eigen_ldlt"}) {
    expect_dense_step(problem, perturbed(problem.x, 0.05), name);
  }
}

TEST_P(Loss, GradientIsThatOfTheCost) {
  Problem problem = with_outliers(20, {GetParam(), 0.6});
  term(problem, "rotation").loss = make_loss({GetParam(), 0.9});
  Unknowns x = perturbed(problem.x, 0.2);
  Linearization linearization(problem, ColumnOrder::kAsGiven);
  EXPECT_NEAR(linearization.evaluate(x), cost(problem, x), 1e-12 * cost(problem, x));
  linearization.linearize(x);
  const double scale = 2 * linearization.Jtr().lpNorm<Eigen::Infinity>();
  for (int c = 0; c < x.X.cols(); c += 3) {
    for (int i = 0; i < 3; ++i) {
      const double at = x.X(i, c), h = 1e-6;
      x.X(i, c) = at + h;
      const double above = cost(problem, x);
      x.X(i, c) = at - h;
      const double below = cost(problem, x);
      x.X(i, c) = at;
      EXPECT_NEAR(2 * linearization.Jtr()[linearization.columns().unknown(i, c)],
                  (above - below) / (2 * h), 1e-6 * scale);
    }
  }
}

TEST_P(Loss, OfALargeScaleIsNone) {
  Problem plain = with_outliers(40, {}), robust = with_outliers(40, {GetParam(), 1000});
  const SolverOptions options = gauss_newton("cholmod", "line_search", 1e-10);
  const Summary a = solve(plain, options), b = solve(robust, options);
  EXPECT_NEAR(a.final_cost, b.final_cost, 1e-4 * a.final_cost);
  EXPECT_LT((plain.x.X - robust.x.X).cwiseAbs().maxCoeff(), 1e-4);
}

TEST_P(Loss, LetsTheOtherHandlesBeMet) {
  const double scale =
      GetParam() == LossKind::kTukey ? 1 : 0.3;  // or it lets go of all at the start
  Problem clean = with_outliers(60, {}), robust = with_outliers(60, {GetParam(), scale});
  Problem torn = with_outliers(60, {});
  const Sample sample = random_sample(60);
  term(clean, "constraint").energy->set_targets(twisted(sample.handles, 0.4, 0.3));
  solve(clean, gauss_newton("auto", "accelerated"));
  solve(torn, gauss_newton("auto", "accelerated"));
  const Summary summary = solve(robust, gauss_newton("auto", "accelerated"));
  EXPECT_EQ(summary.status, Status::kConverged) << summary.message;
  const double off = (robust.x.X - clean.x.X).norm(), without = (torn.x.X - clean.x.X).norm();
  EXPECT_LT(off, 0.3 * without);
}

// The steps are those of Ceres, so that the same minimum is found even where there are several.
TEST_P(Loss, Rung3LevenbergMarquardtAgreesWithCeres) {
  for (const int m : {20, 200}) {
    Problem problem = with_outliers(m, {GetParam(), 1});
    expect_same_minimum(problem, gauss_newton("cholmod", "levenberg", kTight),
                        ceres_with("auto", kTight));
  }
}

// Reweighted steps close the last gap at a constant rate: it takes more of them.
TEST_P(Loss, Rung3EveryLinearSolverAgrees) {
  constexpr double kTighter = 1e-14;
  for (const int m : {20, 200}) {
    for (const char* linear_solver : {"cholmod", "kronecker_cg"}) {
      Problem problem = with_outliers(m, {GetParam(), 1}, 40);
      expect_same_minimum(problem, gauss_newton("cholmod", "line_search", kTighter),
                          gauss_newton(linear_solver, "accelerated", kTighter));
    }
  }
}

// Each d×d block by its mean diagonal, of JᵀJ with the loss in it.
TEST_P(Loss, IsInTheNearestSeparableMatrix) {
  Problem problem = with_outliers(20, {GetParam(), 0.5});
  const Unknowns x = perturbed(problem.x, 0.1);
  Linearization linearization(problem, ColumnOrder::kAsGiven);
  linearization.evaluate(x);
  linearization.linearize(x);
  const Eigen::MatrixXd nearest = linearization.A() + linearization.nearest_of_others();
  const Eigen::MatrixXd JtJ = reference(problem, x).JtJ();
  double largest = 0;
  for (Eigen::Index c = 0; c < nearest.cols(); ++c) {
    for (Eigen::Index r = c; r < nearest.rows(); ++r) {
      const double mean = JtJ.block<3, 3>(3 * r, 3 * c).trace() / 3;
      largest = std::max(largest, std::abs(nearest(r, c) - mean));
    }
  }
  EXPECT_LT(largest, 1e-12 * JtJ.cwiseAbs().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Kinds, Loss, ::testing::ValuesIn(kKinds));

TEST(AnyLoss, ThatLetsGoOfEveryHandleIsSurvived) {
  for (const SolverOptions& options :
       {gauss_newton("cholmod", "accelerated"), gauss_newton("kronecker_cg", "line_search"),
        gauss_newton("auto", "levenberg"), ceres_with("auto")}) {
    Problem problem = with_outliers(30, {});
    Eigen::Matrix3Xd far =
        Eigen::Matrix3Xd::Constant(3, term(problem, "constraint").energy->size(), 9);
    term(problem, "constraint").energy->set_targets(far);
    term(problem, "constraint").loss = make_loss({LossKind::kTukey, 1e-6});
    const Summary summary = solve(problem, options);
    EXPECT_NE(summary.status, Status::kFailed) << summary.message;
    EXPECT_TRUE(problem.x.X.allFinite());
    EXPECT_NEAR(summary.final_cost, summary.initial_cost, 1e-9);
  }
}

TEST(AnyLoss, IsChecked) {
  EXPECT_EQ(make_loss({}), nullptr);
  for (const double scale : {0.0, -1.0, 1e4, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(make_loss({LossKind::kHuber, scale}), InputError) << scale;
    EXPECT_THROW(make_loss({LossKind::kNone, scale}), InputError) << scale;
  }
}

}  // namespace
}  // namespace deformlab::test
