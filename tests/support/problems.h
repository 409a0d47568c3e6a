#pragma once

#include <string>
#include <vector>

#include "solvers/solver.h"
#include "tests/support/samples.h"
#include "tests/support/sparse_system.h"

namespace deformlab::test {

/// All terms that have a weight by default, at rest, with these targets of the handles.
Problem make_problem(const Sample& sample, const Eigen::Matrix3Xd& targets);

/// A plate of m nodes that is twisted and lifted at one end so little that every solver succeeds.
Problem twisted_plate(int m, unsigned seed = 1);

SolverOptions gauss_newton(const std::string& linear_solver, const std::string& globalization,
                           double epsilon = 1e-6);
SolverOptions ceres_with(const std::string& linear_solver, double epsilon = 1e-6);

/// Compiles and solves; the result is left in the problem.
Summary solve(Problem& problem, const SolverOptions& options);

/// The term of this name, and its place among the terms.
std::size_t index_of_term(const Problem& problem, std::string_view name);
WeightedEnergy& term(Problem& problem, std::string_view name);

/// The problem's residuals and Jacobian over all entries of X.
SparseSystem reference(const Problem& problem, const Unknowns& x);

/// #free × #entries: picks the entries of free nodes, in their order.
Eigen::SparseMatrix<double> free_entries(const Problem& problem);

}  // namespace deformlab::test
