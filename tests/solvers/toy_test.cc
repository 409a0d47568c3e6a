#include <gtest/gtest.h>

#include "energies/term_energy.h"
#include "geometry/core/error.h"
#include "tests/solvers/ladder.h"

// Terms over vertices of the plane, one column a node: nothing below the terms knows of graphs.
namespace deformlab::test {
namespace {

template <class T>
using Vector2 = Eigen::Matrix<T, 2, 1>;

struct Pin {  // r = a − q
  static constexpr std::string_view kName = "pin";
  static constexpr Structure kStructure = Structure::kKronecker;
  Eigen::Vector2d q;
  template <class T>
  Vector2<T> operator()(const Vector2<T>& a) const {
    return a - q;
  }
};

struct Difference {  // r = b − a − d
  static constexpr std::string_view kName = "difference";
  static constexpr Structure kStructure = Structure::kKronecker;
  Eigen::Vector2d d;
  template <class T>
  Vector2<T> operator()(const Vector2<T>& a, const Vector2<T>& b) const {
    return b - a - d;
  }
};

struct RightAngle {  // c − b is b − a turned by 90°: mixes x and y
  static constexpr std::string_view kName = "right_angle";
  static constexpr Structure kStructure = Structure::kLinear;
  template <class T>
  Vector2<T> operator()(const Vector2<T>& a, const Vector2<T>& b, const Vector2<T>& c) const {
    const Vector2<T> side = b - a;
    return Vector2<T>(-side.y(), side.x()) - (c - b);
  }
};

struct Rosenbrock {  // More, Garbow and Hillstrom 1981, problem 1: minimum 0 at (1, 1)
  static constexpr std::string_view kName = "rosenbrock";
  static constexpr Structure kStructure = Structure::kNonlinear;
  template <class T>
  Vector2<T> operator()(const Vector2<T>& x) const {
    return {10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]};
  }
};

struct FreudensteinRoth {  // the same, problem 2: minima 0 at (5, 4) and 48.98425… elsewhere
  static constexpr std::string_view kName = "freudenstein_roth";
  static constexpr Structure kStructure = Structure::kNonlinear;
  template <class T>
  Vector2<T> operator()(const Vector2<T>& x) const {
    return {-13.0 + x[0] + ((5.0 - x[1]) * x[1] - 2.0) * x[1],
            -29.0 + x[0] + ((x[1] + 1.0) * x[1] - 14.0) * x[1]};
  }
};

Problem vertices(const Eigen::Matrix2Xd& X) {
  const int n = static_cast<int>(X.cols());
  return {Unknowns::uniform(X, n), std::vector<char>(n, 0), {}};
}

template <class Term>
void add(Problem& problem, Terms<Term> sum, double weight) {
  problem.terms.push_back({std::make_unique<TermEnergy<Term>>(std::move(sum)), weight});
}

// A chain of vertices with both ends pinned; `turning` adds the linear term.
Problem chain(bool turning) {
  constexpr int n = 9;
  Problem problem = vertices(Eigen::Matrix2Xd::Random(2, n));
  Terms<Difference> differences;
  for (int j = 0; j + 1 < n; ++j) differences.add({{1, 0.1 * j}}, {j, j + 1}, 1 + j);
  add(problem, differences, 3);
  Terms<Pin> pins;
  pins.add({{0, 0}}, {0});
  pins.add({{3, 5}}, {n - 1}, 0.5);
  add(problem, pins, 20);
  Terms<RightAngle> angles;
  for (int j = 0; j + 2 < n && turning; ++j) angles.add({}, {j, j + 1, j + 2});
  if (turning) add(problem, angles, 2);
  return problem;
}

void expect_one_step(Problem problem) {
  const Eigen::SparseMatrix<double> P = free_entries(problem);
  const SparseSystem system = reference(problem, problem.x);
  const Eigen::MatrixXd J = system.J * P.transpose();
  const Eigen::VectorXd step = P.transpose() * J.colPivHouseholderQr().solve(-system.r);
  const Eigen::MatrixXd expected = problem.x.X + step.reshaped(2, problem.x.X.cols());
  const Unknowns start = problem.x;
  for (const SolverOptions& options :
       {gauss_newton("cholmod", "none"), gauss_newton("eigen_ldlt", "line_search")}) {
    problem.x = start;
    const Summary s = solve(problem, options);
    EXPECT_EQ(s.status, Status::kConverged);
    EXPECT_LE(s.iterations.size(), 2u);  // the second finds that nothing is left to do
    EXPECT_NEAR(s.iterations[0].cost, s.final_cost, 1e-12 * s.final_cost);
    EXPECT_LT((problem.x.X - expected).cwiseAbs().maxCoeff(), 1e-11);
  }
  problem.x = start;
  solve(problem, ceres_with("auto", 1e-12));
  EXPECT_LT((problem.x.X - expected).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ToyProblem, KroneckerTermsTakeOneStep) { expect_one_step(chain(false)); }

TEST(ToyProblem, LinearTermsTakeOneStep) { expect_one_step(chain(true)); }

TEST(ToyProblem, TakesOneStepWithAVertexFixed) {
  Problem problem = chain(true);
  problem.fixed[4] = 1;
  expect_one_step(std::move(problem));
}

TEST(ToyProblem, GivesTheSameSystemInBothPaths) {
  Problem problem = chain(true);
  expect_same_system(problem, problem.x);
  problem.fixed[2] = 1;
  expect_same_system(problem, perturbed(problem.x, 1));
}

TEST(ToyProblem, AnExactFitConverges) {
  Terms<Pin> pins;
  for (int j = 0; j < 3; ++j) pins.add({{0.1 + j, 0.7}}, {j});
  for (const char* globalization : {"none", "line_search", "levenberg"}) {
    Problem problem = vertices(Eigen::Matrix2Xd::Constant(2, 3, 1000));
    add(problem, pins, 1 / 3.0);
    const Summary s = solve(problem, gauss_newton("cholmod", globalization));
    EXPECT_EQ(s.status, Status::kConverged) << globalization << ": " << s.message;
    EXPECT_LT(s.final_cost, 1e-18);
  }
}

TEST(KnownMinima, RosenbrockIsFoundFromItsUsualStart) {
  for (const SolverOptions& options :
       {gauss_newton("cholmod", "none", 1e-12), gauss_newton("cholmod", "line_search", 1e-12),
        gauss_newton("eigen_ldlt", "levenberg", 1e-12), ceres_with("dense_qr", 1e-12)}) {
    Problem problem = vertices(Eigen::Vector2d(-1.2, 1));
    Terms<Rosenbrock> sum;
    sum.add({}, {0});
    add(problem, sum, 1);
    const Summary s = solve(problem, options);
    EXPECT_NEAR(s.initial_cost, 24.2, 1e-12);
    EXPECT_EQ(s.status, Status::kConverged) << s.message;
    EXPECT_LT((problem.x.X - Eigen::Vector2d(1, 1)).norm(), 1e-6);
  }
}

TEST(KnownMinima, FreudensteinAndRothsLocalOneIsFoundFromItsUsualStart) {
  for (const SolverOptions& options :
       {gauss_newton("cholmod", "levenberg", 1e-12), ceres_with("dense_qr", 1e-12)}) {
    Problem problem = vertices(Eigen::Vector2d(0.5, -2));
    Terms<FreudensteinRoth> sum;
    sum.add({}, {0});
    add(problem, sum, 1);
    const Summary s = solve(problem, options);
    EXPECT_NEAR(s.initial_cost, 400.5, 1e-12);
    EXPECT_NEAR(s.final_cost, 48.98425, 1e-5);
    EXPECT_LT((problem.x.X - Eigen::Vector2d(11.41277, -0.896805)).norm(), 1e-3);
  }
}

TEST(ToyProblem, ATermOfAnotherDimensionIsAnError) {
  Problem problem = twisted_plate(20);
  Terms<Pin> pins;
  pins.add({{0, 0}}, {0});
  add(problem, pins, 1);
  for (const SolverOptions& options : {gauss_newton("cholmod", "none"), ceres_with("auto")}) {
    EXPECT_THROW(make_solver(options)->compile(problem), InputError);
  }
}

TEST(ToyProblem, ANodeThatIsNotThereIsAnError) {
  Problem problem = vertices(Eigen::Vector2d(0, 0));
  Terms<Pin> pins;
  pins.add({{0, 0}}, {1});
  add(problem, pins, 1);
  for (const SolverOptions& options : {gauss_newton("cholmod", "none"), ceres_with("auto")}) {
    EXPECT_THROW(make_solver(options)->compile(problem), InputError);
  }
}

}  // namespace
}  // namespace deformlab::test
