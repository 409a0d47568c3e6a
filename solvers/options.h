#pragma once

#include <array>
#include <string>
#include <vector>

#include "geometry/core/options.h"

namespace deformlab {

/// The solver: our Gauss–Newton method, or Ceres Solver.
enum class SolverMethod { kGaussNewton, kCeres };
constexpr auto names_of(SolverMethod) {
  using enum SolverMethod;
  return std::to_array<EnumName<SolverMethod>>({{kGaussNewton, "gauss_newton"}, {kCeres, "ceres"}});
}

/// How Ceres bounds its steps.
enum class CeresTrustRegion { kLevenbergMarquardt, kDogleg };
constexpr auto names_of(CeresTrustRegion) {
  using enum CeresTrustRegion;
  return std::to_array<EnumName<CeresTrustRegion>>(
      {{kLevenbergMarquardt, "levenberg_marquardt"}, {kDogleg, "dogleg"}});
}

/// The library that factors Ceres' sparse matrices.
enum class CeresSparseLibrary { kSuiteSparse, kEigenSparse, kCxSparse };
constexpr auto names_of(CeresSparseLibrary) {
  using enum CeresSparseLibrary;
  return std::to_array<EnumName<CeresSparseLibrary>>(
      {{kSuiteSparse, "suite_sparse"}, {kEigenSparse, "eigen_sparse"}, {kCxSparse, "cx_sparse"}});
}

/// A parameter block of Ceres is one column of a node or a whole node. With columns, derivatives
/// that are zero are left out, so that the factor stays sparse. Whole nodes give fewer and denser
/// blocks and are a little faster on small graphs.
enum class CeresBlocks { kColumn, kNode };
constexpr auto names_of(CeresBlocks) {
  using enum CeresBlocks;
  return std::to_array<EnumName<CeresBlocks>>({{kColumn, "column"}, {kNode, "node"}});
}

/// The names of a method's linear solvers, also registered ones, without "auto".
std::vector<std::string> linear_solver_choices(SolverMethod method);

/// "auto" and the linear solvers of all methods.
std::vector<std::string> linear_solver_choices();

/// The names of the globalizations of gauss_newton, also registered ones.
std::vector<std::string> globalization_choices();

/// The options of a solver. They are the same for every method.
struct SolverOptions {
  SolverMethod method = SolverMethod::kGaussNewton;
  /// In gauss_newton, cholmod factors JᵀJ in each step, as the paper does. eigen_ldlt does the same
  /// without BLAS. kronecker_cg runs conjugate gradients with one small factorization for a set of
  /// handles as the preconditioner, and is the fastest if most terms have the Kronecker structure.
  /// auto takes kronecker_cg if the terms suit it and the equations are well conditioned, and
  /// cholmod otherwise. ceres has the linear solvers that Ceres Solver documents; there, auto is
  /// sparse_normal_cholesky.
  std::string linear_solver = "auto";
  /// For gauss_newton only. none takes full steps, as in the paper; they can increase F.
  /// line_search halves a step until F decreases. levenberg damps it by λ diag(JᵀJ). accelerated
  /// makes directions conjugate, interpolates their lengths, and improves poor steps by geodesic
  /// acceleration and damping.
  std::string globalization = "accelerated";
  CeresTrustRegion ceres_trust_region = CeresTrustRegion::kLevenbergMarquardt;
  CeresSparseLibrary ceres_sparse_library = CeresSparseLibrary::kSuiteSparse;
  CeresBlocks ceres_blocks = CeresBlocks::kColumn;
  double epsilon = 1e-6;  ///< ε of Eq. 12
  int max_iterations = 100;
  int threads = 1;  ///< the result does not depend on it, except for rounding errors of Ceres

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("method", o.method, "The solver that minimises the energy");
    visit.choice("linear_solver", o.linear_solver, linear_solver_choices(),
                 "How the linear equations of a step are solved. cholmod, eigen_ldlt and "
                 "kronecker_cg belong to gauss_newton, the others to ceres, and auto takes the "
                 "fastest that suits the energy terms");
    visit.choice("globalization", o.globalization, globalization_choices(),
                 "How gauss_newton chooses the length of a step: full steps as in the paper "
                 "(none), halved until the energy falls (line_search), damped (levenberg), or "
                 "along conjugate directions with interpolated lengths (accelerated)");
    visit("ceres_trust_region", o.ceres_trust_region, "How ceres bounds its steps");
    visit("ceres_sparse_library", o.ceres_sparse_library,
          "The library with which ceres factors sparse matrices");
    visit("ceres_blocks", o.ceres_blocks,
          "What a parameter block of ceres is: a column of a node's unknowns, or a whole node");
    visit.range("epsilon", o.epsilon,
                {.min = 0, .max = 1, .exclusive_min = true, .exclusive_max = true},
                "The tolerance of the three conditions of convergence (Sumner et al. 2007, "
                "Eq. 12); the paper uses 1e-6");
    visit.range("max_iterations", o.max_iterations, {.min = 1},
                "The solver stops after this number of steps even if it has not converged");
    visit.range("threads", o.threads, {.min = 1, .max = 1024},
                "The number of threads of the solver. It does not change the result, apart from "
                "the rounding of ceres");
  }
};

}  // namespace deformlab
