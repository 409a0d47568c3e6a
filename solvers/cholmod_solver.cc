#include "solvers/cholmod_solver.h"

#include <algorithm>
#include <stdexcept>

namespace deformlab {
namespace {

// CHOLMOD's view of Eigen's arrays: no copy.
cholmod_sparse view(const SparseMatrix& lower) {
  cholmod_sparse A{};
  A.nrow = lower.rows();
  A.ncol = lower.cols();
  A.nzmax = lower.nonZeros();
  A.p = const_cast<int*>(lower.outerIndexPtr());
  A.i = const_cast<int*>(lower.innerIndexPtr());
  A.x = const_cast<double*>(lower.valuePtr());
  A.stype = -1;  // symmetric, lower triangle stored
  A.itype = CHOLMOD_INT;
  A.xtype = CHOLMOD_REAL;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = 1;
  A.packed = 1;
  return A;
}

}  // namespace

CholmodSolver::CholmodSolver() {
  cholmod_start(&common_);
  common_.print = 0;
  common_.supernodal = CHOLMOD_SUPERNODAL;
  common_.final_ll = 1;
  common_.try_catch =
      1;  // a matrix that is not positive definite is our caller's news, not stderr's
}

CholmodSolver::~CholmodSolver() {
  free_factor();
  cholmod_free_dense(&x_, &common_);
  cholmod_free_dense(&Y_, &common_);
  cholmod_free_dense(&E_, &common_);
  cholmod_finish(&common_);
}

void CholmodSolver::free_factor() { cholmod_free_factor(&L_, &common_); }

Eigen::VectorXi CholmodSolver::order(const SparseMatrix& lower) {
  cholmod_sparse A = view(lower);
  common_.nmethods = 2;
  common_.method[0].ordering = CHOLMOD_METIS;
  common_.method[1].ordering = CHOLMOD_AMD;
  common_.postorder = 1;
  free_factor();
  L_ = cholmod_analyze(&A, &common_);
  if (L_ == nullptr) throw std::bad_alloc();
  return Eigen::Map<const Eigen::VectorXi>(static_cast<const int*>(L_->Perm), lower.rows());
}

void CholmodSolver::analyze(const SparseMatrix& lower) {
  cholmod_sparse A = view(lower);
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_NATURAL;
  common_.postorder = 0;  // `order` has done it: then the matrix is used in place, without a copy
  free_factor();
  L_ = cholmod_analyze(&A, &common_);
  if (L_ == nullptr) throw std::bad_alloc();
}

bool CholmodSolver::factorize(const SparseMatrix& lower) {
  cholmod_sparse A = view(lower);
  cholmod_factorize(&A, L_, &common_);
  if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  return common_.status == CHOLMOD_OK && cholmod_rcond(L_, &common_) > kSingularRatio;
}

void CholmodSolver::solve(const Eigen::VectorXd& b, Eigen::VectorXd& delta) {
  cholmod_dense B{};
  B.nrow = B.nzmax = B.d = b.size();
  B.ncol = 1;
  B.x = const_cast<double*>(b.data());
  B.xtype = CHOLMOD_REAL;
  B.dtype = CHOLMOD_DOUBLE;
  if (!cholmod_solve2(CHOLMOD_A, L_, &B, nullptr, &x_, nullptr, &Y_, &E_, &common_)) {
    throw std::bad_alloc();
  }
  delta = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(x_->x), b.size());
}

long CholmodSolver::nonzeros() const { return static_cast<long>(common_.lnz); }

}  // namespace deformlab
