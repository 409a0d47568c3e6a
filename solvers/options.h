#pragma once

#include <string>

namespace deformlab {

/// Everything a solve can be told; the same for every method.
struct SolverOptions {
  std::string method = "gauss_newton";  ///< gauss_newton | ceres
  /// Of gauss_newton: cholmod (the paper's way, a factorization in each step), eigen_ldlt (the same
  /// without BLAS), kronecker_cg (conjugate gradients, preconditioned by one small factorization
  /// for a set of handles: the fastest where terms are Kronecker). Of ceres: dense_qr,
  /// dense_normal_cholesky, sparse_normal_cholesky, dense_schur, sparse_schur, iterative_schur,
  /// cgnr. auto: kronecker_cg where the terms suit it, and cholmod where they do not or where it
  /// turns out too badly conditioned; sparse_normal_cholesky for ceres.
  std::string linear_solver = "auto";
  /// none: full steps, as in the paper; they can go uphill. line_search: the step is halved until F
  /// falls. levenberg: damped by λ diag(JᵀJ), which is what ceres always does. accelerated: the
  /// directions are made conjugate, their lengths interpolated, and those that are poor bent or
  /// damped: fewer steps than the other three on every scene that was tried.
  std::string globalization = "accelerated";
  std::string ceres_trust_region = "levenberg_marquardt";  ///< or dogleg
  std::string ceres_sparse_library = "suite_sparse";       ///< or eigen_sparse | cx_sparse
  /// column: one parameter block a column of a node, so that zero derivatives are left out and the
  /// factor stays sparse; node: one a node, fewer and denser (a little faster on small graphs).
  std::string ceres_blocks = "column";
  double epsilon = 1e-6;  ///< ε of Eq. 12
  int max_iterations = 100;
  /// Of the solver and the transfer. The result does not depend on them, but for Ceres' rounding.
  int threads = 1;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.choice("method", o.method, {"gauss_newton", "ceres"}, "who minimises");
    visit.choice(
        "linear_solver", o.linear_solver,
        {"auto", "cholmod", "eigen_ldlt", "kronecker_cg", "dense_qr", "dense_normal_cholesky",
         "sparse_normal_cholesky", "dense_schur", "sparse_schur", "iterative_schur", "cgnr"},
        "gauss_newton: cholmod, eigen_ldlt, kronecker_cg; ceres: the others; auto: the fastest "
        "that suits the terms");
    visit.choice(
        "globalization", o.globalization, {"none", "line_search", "levenberg", "accelerated"},
        "of gauss_newton: full steps (the paper's), halved steps, damped ones, or conjugate "
        "ones of interpolated length");
    visit.choice("ceres_trust_region", o.ceres_trust_region, {"levenberg_marquardt", "dogleg"},
                 "of ceres");
    visit.choice("ceres_sparse_library", o.ceres_sparse_library,
                 {"suite_sparse", "eigen_sparse", "cx_sparse"}, "of ceres");
    visit.choice("ceres_blocks", o.ceres_blocks, {"column", "node"},
                 "of ceres: what its parameter blocks are");
    visit("epsilon", o.epsilon, "of the three conditions of Eq. 12");
    visit("max_iterations", o.max_iterations, "steps at most");
    visit("threads", o.threads,
          "of the solver and the transfer; they do not change the result, but for Ceres' rounding");
  }
};

}  // namespace deformlab
