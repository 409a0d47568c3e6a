#include "solvers/linear/linear_solver.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include "geometry/core/error.h"
#include "solvers/linear/cholmod_solver.h"

namespace deformlab {
namespace {

// Eigen's simplicial LDLᵀ: no BLAS, no supernodes; the independent second opinion.
class EigenLdlt final : public LinearSolver {
 public:
  Eigen::VectorXi order(const SparseMatrix& lower, int, bool) override {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), permutation);
    return permutation.indices();
  }
  void analyze(const SparseMatrix& lower) override { ldlt_.analyzePattern(lower); }
  bool factorize(const SparseMatrix& lower) override {
    ldlt_.factorize(lower);
    if (ldlt_.info() != Eigen::Success) return false;
    nonzeros_ = ldlt_.matrixL().nestedExpression().nonZeros();
    const auto D = ldlt_.vectorD();
    return D.minCoeff() > kSingularRatio * D.maxCoeff();
  }
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& delta) override { delta = ldlt_.solve(b); }
  long nonzeros() const override { return nonzeros_; }

 private:
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> ldlt_;
  long nonzeros_ = 0;  // which Eigen does not tell before the first factorization
};

}  // namespace

std::unique_ptr<LinearSolver> make_linear_solver(const std::string& name, int threads) {
  if (name == "cholmod") return std::make_unique<CholmodSolver>(threads);
  if (name == "eigen_ldlt") return std::make_unique<EigenLdlt>();
  throw InputError(
      "solver.linear_solver '" + name +
      "' is not one of gauss_newton's; known: auto, cholmod, eigen_ldlt, kronecker_cg");
}

}  // namespace deformlab
