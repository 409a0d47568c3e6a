#include <gmock/gmock.h>

#include "energies/term_energy.h"
#include "tests/solvers/ladder.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

class KroneckerCg : public ::testing::TestWithParam<int> {
 protected:
  void expect_the_minimum_of_a_factorization(const std::string& globalization) {
    Problem direct = twisted_plate(GetParam()), inexact = twisted_plate(GetParam());
    for (int j = 0; j < direct.x.nodes() && fixed_; j += 5) direct.fixed[j] = inexact.fixed[j] = 1;
    const Summary expected = solve(direct, gauss_newton("cholmod", globalization));
    const Summary s = solve(inexact, gauss_newton("kronecker_cg", globalization));
    EXPECT_EQ(s.status, Status::kConverged);
    EXPECT_NEAR(s.final_cost, expected.final_cost, 1e-6 * expected.final_cost);
    EXPECT_EQ(s.factorizations, 0);
    EXPECT_GT(s.cg_iterations, 0);
    EXPECT_LT(s.nonzeros_factor, expected.nonzeros_factor);
  }

  bool fixed_ = false;
};

TEST_P(KroneckerCg, FindsTheMinimumOfAFactorization) {
  expect_the_minimum_of_a_factorization("line_search");
}

TEST_P(KroneckerCg, FindsItDamped) { expect_the_minimum_of_a_factorization("levenberg"); }

TEST_P(KroneckerCg, FindsItWithNodesFixed) {
  fixed_ = true;
  expect_the_minimum_of_a_factorization("line_search");
}

TEST_P(KroneckerCg, FindsItAccelerated) { expect_the_minimum_of_a_factorization("accelerated"); }

INSTANTIATE_TEST_SUITE_P(Nodes, KroneckerCg, ::testing::Values(20, 200, 1000));

// A from the Kronecker terms, a block a node from the others.
TEST(KroneckerCgProduct, IsThatWithJtJ) {
  Problem problem = twisted_plate(50);
  for (int j = 0; j < problem.x.nodes(); j += 5) problem.fixed[j] = 1;
  const Unknowns x = perturbed(problem.x, 0.1);
  Linearization linearization(problem, ColumnOrder::kAsGiven);
  linearization.evaluate(x);
  linearization.linearize(x);
  ColumnBlock p = ColumnBlock::Random(4, linearization.columns().count());
  p.row(3).setZero();
  ColumnBlock Hp = ColumnBlock::Zero(4, p.cols());
  add_product(linearization.A(), p, Hp);
  for (const ElementDerivatives* part : linearization.derivatives()) {
    std::vector<double> scratch(part->width());
    part->add_product(p, Hp, scratch.data());
  }
  const Eigen::VectorXd direction = p.topRows(3).reshaped();
  const Eigen::SparseMatrix<double> P = free_entries(problem);
  const Eigen::VectorXd everywhere = P.transpose() * direction;
  const Eigen::VectorXd expected = P * (reference(problem, x).JtJ() * everywhere);
  const Eigen::VectorXd product = Hp.topRows(3).reshaped();
  EXPECT_LT(relative_difference(product, expected), 1e-12);
  EXPECT_EQ(Hp.row(3).cwiseAbs().maxCoeff(), 0);
}

// Coordinates that no term couples stay apart in JᵀJ.
TEST(NormalMatrix, HasNoMoreEntriesThanTheTermsNeed) {
  Problem problem = twisted_plate(50);
  std::erase_if(problem.terms, [](const WeightedEnergy& term) {
    return term.energy->structure() != Structure::kKronecker;
  });
  const Linearization linearization(problem, ColumnOrder::kAsGiven);
  const NormalMatrix matrix(linearization, as_given);
  EXPECT_EQ(matrix.H().nonZeros(), 3 * linearization.A().nonZeros());
}

// With Kronecker terms alone the preconditioner is the matrix itself.
TEST(KroneckerCgPreconditioner, IsExactForKroneckerTerms) {
  Problem problem = twisted_plate(50);
  std::erase_if(problem.terms, [](const WeightedEnergy& term) {
    return term.energy->structure() != Structure::kKronecker;
  });
  ASSERT_EQ(problem.terms.size(), 2u);
  const Summary s = solve(problem, gauss_newton("kronecker_cg", "line_search"));
  EXPECT_EQ(s.status, Status::kConverged);
  EXPECT_LE(s.iterations.size(), 2u);
  EXPECT_LE(s.cg_iterations, 2);
}

TEST(KroneckerCgPreconditioner, TakesAProblemWhereEveryNodeIsFixed) {
  Problem problem = twisted_plate(20);
  problem.fixed.assign(problem.fixed.size(), 1);
  const Summary s = solve(problem, gauss_newton("kronecker_cg", "line_search"));
  EXPECT_EQ(s.status, Status::kConverged);
  EXPECT_THAT(s.message, HasSubstr("every node is fixed"));
}

TEST(KroneckerCgPreconditioner, TakesAProblemWithoutAnyHandle) {
  Problem problem = twisted_plate(20);
  std::erase_if(problem.terms,
                [](const WeightedEnergy& term) { return term.energy->name() == "constraint"; });
  problem.x = perturbed(problem.x, 0.05);
  const Summary s = solve(problem, gauss_newton("kronecker_cg", "line_search"));
  EXPECT_TRUE(std::isfinite(s.final_cost));
  EXPECT_LT(s.final_cost, 1e-3 * s.initial_cost);
  EXPECT_TRUE(problem.x.X.allFinite());
}

// M may have entries outside the pattern of A, whose postorder the columns are in: where a plate is
// flat, the coordinate across it couples nothing until the plate is bent.
TEST(KroneckerCgPreconditioner, TakesAFlatPlateThatIsCompiledAgainWhenBent) {
  Eigen::Matrix3Xd g = random_points(2000, {3, 1, 0}, 1), v = random_points(30000, {3, 1, 0}, 2);
  const Sample sample = make_sample(g, v, 4);
  Problem problem = make_problem(sample, twisted(sample.handles, 0.4, 0.3));
  const auto solver = make_solver(gauss_newton("kronecker_cg", "accelerated"));
  for (int i = 0; i < 2; ++i) {
    solver->compile(problem);
    const Summary s = solver->solve(problem);
    EXPECT_EQ(s.status, Status::kConverged) << s.message;
    EXPECT_GT(s.nonzeros_factor, 200000);
  }
}

// A loss makes the constraint one of the other terms, so that A has no entries from handles.
TEST(KroneckerCgPreconditioner, TakesALossOnTheConstraintOfALargeGraph) {
  Problem problem = twisted_plate(2000);
  term(problem, "constraint").loss = make_loss({LossKind::kHuber, 1});
  const Summary s = solve(problem, gauss_newton("kronecker_cg", "accelerated"));
  EXPECT_EQ(s.status, Status::kConverged) << s.message;
  EXPECT_GT(s.nonzeros_factor, 200000);
}

TEST(Auto, TakesConjugateGradientsForAGraph) {
  Problem problem = twisted_plate(200);
  const Summary s = solve(problem, gauss_newton("auto", "accelerated"));
  EXPECT_EQ(s.status, Status::kConverged);
  EXPECT_EQ(s.linear_solver, "kronecker_cg");
  EXPECT_THAT(s.choice, HasSubstr("Kronecker"));
  EXPECT_GE(s.condition, 1);
  EXPECT_LT(s.condition, 1e4);
}

TEST(Auto, FactorsWhatIsSmall) {
  Problem problem = twisted_plate(5);
  const Summary s = solve(problem, gauss_newton("auto", "accelerated"));
  EXPECT_EQ(s.linear_solver, "cholmod");
  EXPECT_THAT(s.choice, HasSubstr("60 unknowns"));
}

struct Link {  // r = b − a
  static constexpr std::string_view kName = "link";
  static constexpr Structure kStructure = Structure::kKronecker;
  template <class T>
  Eigen::Matrix<T, 2, 1> operator()(const Eigen::Matrix<T, 2, 1>& a,
                                    const Eigen::Matrix<T, 2, 1>& b) const {
    return b - a;
  }
};

struct Rail {  // r = (n · a)² − 1: a vertex is on one of two lines
  static constexpr std::string_view kName = "rail";
  static constexpr Structure kStructure = Structure::kNonlinear;
  Eigen::Vector2d n;
  template <class T>
  Eigen::Matrix<T, 1, 1> operator()(const Eigen::Matrix<T, 2, 1>& a) const {
    return Eigen::Matrix<T, 1, 1>(a.dot(n) * a.dot(n) - T(1));
  }
};

// A chain of vertices on rails that all but fix one coordinate each: the preconditioner, which
// knows no difference between coordinates, all but fixes both.
class Chain : public ::testing::Test {
 protected:
  static constexpr int n = 1000;
  Problem problem_{Unknowns::uniform(Eigen::Matrix2Xd::Zero(2, n), n), std::vector<char>(n, 0), {}};
  Eigen::Matrix2Xd on_rails_{2, n};

  Chain() {
    Terms<Link> links;
    Terms<Rail> rails;
    for (int j = 0; j < n; ++j) {
      if (j > 0) links.add({}, {j - 1, j});
      const double angle = 0.001 * j;
      const Eigen::Vector2d along(std::cos(angle), std::sin(angle)), across(-along[1], along[0]);
      on_rails_.col(j) = across + std::sin(0.01 * j) * along;
      rails.add({across}, {j});
    }
    problem_.fixed.front() = problem_.fixed.back() = 1;
    problem_.terms.push_back({std::make_unique<TermEnergy<Link>>(std::move(links)), 1});
    problem_.terms.push_back({std::make_unique<TermEnergy<Rail>>(std::move(rails)), 1e8});
  }
};

TEST_F(Chain, IsFactoredWhereItsConditionIsSeenAtOnce) {
  problem_.x.X = on_rails_;
  const Summary s = solve(problem_, gauss_newton("auto", "accelerated"));
  EXPECT_EQ(s.status, Status::kConverged) << s.message;
  EXPECT_EQ(s.linear_solver, "cholmod");
  EXPECT_THAT(s.choice, HasSubstr("condition"));
  EXPECT_EQ(s.cg_iterations, 0);
}

// Where all is 0 the rails have no derivative.
TEST_F(Chain, IsFactoredInTheEndWhereItsConditionIsSeenLate) {
  const auto solver = make_solver(gauss_newton("auto", "accelerated"));
  solver->compile(problem_);
  problem_.x.X = on_rails_;
  const Summary s = solver->solve(problem_);
  EXPECT_EQ(s.status, Status::kConverged) << s.message;
  EXPECT_EQ(s.linear_solver, "cholmod");
  EXPECT_THAT(s.choice, HasSubstr("did not converge"));
  ASSERT_FALSE(s.notes.empty());
  EXPECT_THAT(s.notes.front(), HasSubstr("JᵀJ is factored instead"));
}

TEST(KroneckerCgAlone, SaysThatItFailsWhereNothingCanBeFactored) {
  for (const char* linear_solver : {"kronecker_cg", "auto"}) {
    Problem problem = twisted_plate(30);
    term(problem, "rotation").weight = 1e308;
    const Summary s = solve(problem, gauss_newton(linear_solver, "accelerated"));
    EXPECT_EQ(s.status, Status::kFailed) << linear_solver << ": " << s.message;
    EXPECT_TRUE(problem.x.X.allFinite());
  }
}

}  // namespace
}  // namespace deformlab::test
