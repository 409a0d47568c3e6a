#include "tests/solvers/ladder.h"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "solvers/ceres/ceres_solver.h"
#include "solvers/gauss_newton/step_solvers/normal_matrix.h"
#include "solvers/linear/linear_solver.h"

namespace deformlab::test {

CeresSystem ceres_system(const Problem& problem, const Unknowns& x, CeresBlocks blocks) {
  SolverOptions solver_options = ceres_with("auto");
  solver_options.ceres_blocks = blocks;
  CeresSolver solver(solver_options);
  solver.compile(problem);
  solver.x().X = x.X;
  std::vector<double*> all;
  solver.problem().GetParameterBlocks(&all);
  std::sort(all.begin(), all.end());  // all lie in x().X: now in its order
  ceres::Problem::EvaluateOptions options;
  for (double* block : all) {
    const bool fixed = solver.problem().IsParameterBlockConstant(block);
    if (!fixed) options.parameter_blocks.push_back(block);
  }
  std::vector<double> r, gradient;
  ceres::CRSMatrix crs;
  solver.problem().Evaluate(options, nullptr, &r, &gradient, &crs);
  const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> J(
      crs.num_rows, crs.num_cols, std::ssize(crs.values), crs.rows.data(), crs.cols.data(),
      crs.values.data());
  return {Eigen::Map<Eigen::VectorXd>(r.data(), std::ssize(r)),
          Eigen::Map<Eigen::VectorXd>(gradient.data(), std::ssize(gradient)), J};
}

Eigen::VectorXi as_given(const SparseMatrix& lower) {
  const auto n = static_cast<int>(lower.cols());
  return Eigen::VectorXi::LinSpaced(n, 0, n - 1);
}

NormalSystem normal_system(const Problem& problem, const Unknowns& x, bool reordered) {
  Linearization linearization(problem,
                              reordered ? ColumnOrder::kFillReducing : ColumnOrder::kAsGiven);
  NormalMatrix matrix(linearization, [&](const SparseMatrix& lower) {
    return reordered ? make_cholmod()->order(lower) : as_given(lower);
  });
  linearization.evaluate(x);
  linearization.linearize(x);
  matrix.update(linearization);
  const int n = linearization.unknowns();
  std::vector<Eigen::Triplet<double>> in_H, in_Jtr;
  for (int c = 0; c < x.X.cols(); ++c) {
    for (int i = 0; i < x.dimension(); ++i) {
      const int unknown = linearization.columns().unknown(i, c);
      if (unknown < 0) continue;
      const auto entry = static_cast<int>(in_H.size());
      in_H.emplace_back(entry, matrix.position()[unknown], 1);
      in_Jtr.emplace_back(entry, unknown, 1);
    }
  }
  Eigen::SparseMatrix<double> P(n, n), Q(n, n);
  P.setFromTriplets(in_H.begin(), in_H.end());
  Q.setFromTriplets(in_Jtr.begin(), in_Jtr.end());
  const Eigen::SparseMatrix<double> full = matrix.H().selfadjointView<Eigen::Lower>();
  return {P * full * P.transpose(), Q * linearization.Jtr()};
}

void expect_same_system(const Problem& problem, const Unknowns& x) {
  const SparseSystem all = reference(problem, x);
  const Eigen::SparseMatrix<double> J = all.J * free_entries(problem).transpose();
  const Eigen::SparseMatrix<double> JtJ = J.transpose() * J;
  const Eigen::VectorXd Jtr = J.transpose() * all.r;
  for (const CeresBlocks blocks : {CeresBlocks::kColumn, CeresBlocks::kNode}) {
    const CeresSystem theirs = ceres_system(problem, x, blocks);
    EXPECT_LT(relative_difference(all.r, theirs.r), 1e-12) << blocks;
    EXPECT_LT(relative_difference(J, theirs.J), 1e-12) << blocks;
    EXPECT_LT(relative_difference(Jtr, theirs.gradient), 1e-12) << blocks;
  }
  for (const bool reordered : {false, true}) {
    const NormalSystem ours = normal_system(problem, x, reordered);
    EXPECT_LT(relative_difference(ours.H, JtJ), 1e-12) << reordered;
    EXPECT_LT(relative_difference(ours.Jtr, Jtr), 1e-12) << reordered;
  }
}

void expect_dense_step(Problem& problem, const Unknowns& x, const std::string& linear_solver) {
  const SparseSystem all = reference(problem, x);
  const Eigen::SparseMatrix<double> P = free_entries(problem), J = all.J * P.transpose();
  const Eigen::MatrixXd JtJ = Eigen::SparseMatrix<double>(J.transpose() * J);
  const Eigen::VectorXd expected = P.transpose() * JtJ.llt().solve(J.transpose() * -all.r);
  SolverOptions options = gauss_newton(linear_solver, "none");
  options.max_iterations = 1;
  problem.x = x;
  const Summary summary = solve(problem, options);
  const Eigen::VectorXd step = (problem.x.X - x.X).reshaped();
  EXPECT_EQ(summary.notes, std::vector<std::string>{});
  EXPECT_LT(relative_difference(step, expected), 1e-9) << linear_solver;
}

void expect_same_minimum(Problem& problem, const SolverOptions& one, const SolverOptions& other) {
  const Unknowns start = problem.x;
  const Summary a = solve(problem, one);
  const Eigen::MatrixXd X = std::exchange(problem.x, start).X;
  const Summary b = solve(problem, other);
  EXPECT_EQ(a.status, Status::kConverged) << a.message;
  EXPECT_EQ(b.status, Status::kConverged) << b.message;
  EXPECT_LT(std::abs(a.final_cost - b.final_cost), 1e-9 * a.final_cost);
  EXPECT_LT((X - problem.x.X).cwiseAbs().maxCoeff(), 1e-6 * X.cwiseAbs().maxCoeff());
  EXPECT_LT(a.final_cost, 0.9 * a.initial_cost);
}

}  // namespace deformlab::test
