#include <ceres/loss_function.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "energies/term_energy.h"
#include "tests/support/problems.h"

namespace deformlab::test {
namespace {

using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// One coordinate and one column a node.
template <class Term>
Problem problem_of(double start, const Term& term, int nodes = 1) {
  const Eigen::MatrixXd X = Eigen::MatrixXd::Constant(1, nodes, start);
  Problem problem{Unknowns::uniform(X, nodes), std::vector<char>(nodes, 0), {}};
  Terms<Term> sum;
  for (int j = 0; j < nodes; ++j) sum.add(term, {j});
  problem.terms.push_back({std::make_unique<TermEnergy<Term>>(std::move(sum))});
  return problem;
}

// log x, which the first full step makes NaN from any start above e.
struct Logarithm {
  static constexpr std::string_view kName = "logarithm";
  template <class T>
  Vector<T, 1> operator()(const Vector<T, 1>& x) const {
    return Vector<T, 1>(log(x[0]));
  }
};

// x − 1, but NaN everywhere but at the start.
struct Trap {
  static constexpr std::string_view kName = "trap";
  double start;
  template <class T>
  Vector<T, 1> operator()(const Vector<T, 1>& x) const {
    return Vector<T, 1>(x[0] == T(start) ? x[0] - 1.0 : x[0] * kNaN);
  }
};

// x − 1, whose derivative is NaN below a limit.
struct NoSlope {
  static constexpr std::string_view kName = "no_slope";
  double limit;
  template <class T>
  Vector<T, 1> operator()(const Vector<T, 1>& x) const {
    return Vector<T, 1>(x[0] - 1.0);
  }
  Eigen::Matrix<double, 1, 1> jacobian(const Eigen::Matrix<double, 1, 1>& x) const {
    return Eigen::Matrix<double, 1, 1>(x[0] < limit ? kNaN : 1);
  }
};

// x − 1, which throws below a limit.
struct Throwing {
  static constexpr std::string_view kName = "throwing";
  double limit;
  template <class T>
  Vector<T, 1> operator()(const Vector<T, 1>& x) const {
    if (x[0] < T(limit)) throw std::domain_error("x is too small");
    return Vector<T, 1>(x[0] - 1.0);
  }
};

class ThrowingLoss final : public ceres::LossFunction {
 public:
  void Evaluate(double s, double rho[3]) const override {
    if (s < 1) throw std::domain_error("s is too small");
    rho[0] = s, rho[1] = 1, rho[2] = 0;
  }
};

std::vector<SolverOptions> all_solvers() {
  std::vector<SolverOptions> result;
  for (const char* globalization : {"none", "line_search", "levenberg", "accelerated"}) {
    result.push_back(gauss_newton("cholmod", globalization));
  }
  result.push_back(ceres_with("auto"));
  result.push_back(ceres_with("auto"));
  result.back().threads = 2;
  return result;
}

TEST(FailingEnergy, AStepToNaNIsUphill) {
  for (const SolverOptions& options : all_solvers()) {
    if (options.globalization == "none") continue;
    Problem problem = problem_of(30, Logarithm());
    const Summary s = solve(problem, options);
    EXPECT_EQ(s.status, Status::kConverged) << s.method << ' ' << s.globalization << s.message;
    EXPECT_NEAR(problem.x.X(0, 0), 1, 1e-3);
  }
}

TEST(FailingEnergy, AFullStepToNaNFailsAndNamesTheTerm) {
  Problem problem = problem_of(30, Logarithm());
  const Summary s = solve(problem, gauss_newton("cholmod", "none"));
  EXPECT_EQ(s.status, Status::kFailed);
  EXPECT_THAT(s.message, HasSubstr("'logarithm'"));
  EXPECT_EQ(problem.x.X(0, 0), 30);
}

TEST(FailingEnergy, NaNWhereverAStepLeadsKeepsTheStartAndNamesTheTerm) {
  for (const SolverOptions& options : all_solvers()) {
    Problem problem = problem_of(30, Trap{30});
    const Summary s = solve(problem, options);
    EXPECT_NE(s.status, Status::kConverged);
    EXPECT_THAT(s.message, HasSubstr("'trap'"));
    EXPECT_EQ(s.final_cost, 29 * 29);
    EXPECT_EQ(problem.x.X(0, 0), 30);
  }
}

TEST(FailingEnergy, ADerivativeThatIsNaNIsNoStepAndNamesTheTerm) {
  for (const double limit : {20, 40}) {  // after a step, at the start
    for (const SolverOptions& options : all_solvers()) {
      Problem problem = problem_of(30, NoSlope{limit});
      const Summary s = solve(problem, options);
      EXPECT_EQ(s.status, Status::kFailed) << s.method << ' ' << s.globalization;
      EXPECT_THAT(s.message, HasSubstr("'no_slope'"));
      EXPECT_EQ(problem.x.X(0, 0), 30);
    }
  }
}

TEST(FailingEnergy, NaNIsNoOutlierOfALoss) {
  for (const LossKind kind : {LossKind::kHuber, LossKind::kCauchy, LossKind::kTukey}) {
    Problem problem = problem_of(kNaN, Logarithm());
    problem.terms[0].loss = make_loss({kind, 1});
    const Summary s = solve(problem, gauss_newton("cholmod", "accelerated"));
    EXPECT_EQ(s.status, Status::kFailed);
    EXPECT_THAT(s.message, HasSubstr("'logarithm'"));
  }
}

// Many elements, so that Ceres evaluates them in its own threads.
TEST(FailingEnergy, AnExceptionReachesTheCallerFromThreads) {
  for (const SolverOptions& options : all_solvers()) {
    Problem problem = problem_of(30, Throwing{20}, 1000);
    const auto solver = make_solver(options);
    solver->compile(problem);
    EXPECT_THROW(solver->solve(problem), std::domain_error) << options.globalization;
    problem.x.X.setConstant(30);
    problem.fixed.assign(1000, 1);
    solver->compile(problem);  // the solver can be used again
    EXPECT_NE(solver->solve(problem).status, Status::kFailed);
  }
}

TEST(FailingEnergy, AnExceptionOfALossReachesTheCallerFromThreads) {
  for (const SolverOptions& options : all_solvers()) {
    Problem problem = problem_of(30, Throwing{-1e9}, 1000);
    problem.terms[0].loss = std::make_shared<ThrowingLoss>();
    const auto solver = make_solver(options);
    solver->compile(problem);
    EXPECT_THROW(solver->solve(problem), std::domain_error) << options.globalization;
  }
}

}  // namespace
}  // namespace deformlab::test
