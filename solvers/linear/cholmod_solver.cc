#include "solvers/linear/cholmod_solver.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "solvers/linear/cholmod_view.h"
#include "solvers/linear/one_thread.h"

namespace deformlab {
namespace {

// The structure of groups of consecutive rows: an order of them takes a fraction of the time, and
// fills no more where the rows of a group have almost the same neighbours.
SparseMatrix quotient(const SparseMatrix& lower, int group) {
  const Eigen::Index n = lower.cols() / group;
  std::vector<int> last(n, -1);  // the column in which a row was met last
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < lower.cols(); ++c) {
    for (SparseMatrix::InnerIterator it(lower, c); it; ++it) {
      const int row = static_cast<int>(it.row()) / group;
      if (std::exchange(last[row], c / group) != c / group) entries.emplace_back(row, c / group, 1);
    }
  }
  SparseMatrix result(n, n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

std::vector<int> expand(const Eigen::VectorXi& order, int group) {
  std::vector<int> result;
  for (const int g : order) {
    for (int i = 0; i < group; ++i) result.push_back(group * g + i);
  }
  return result;
}

}  // namespace

CholmodSolver::CholmodSolver(int threads) : threads_(threads) {
  cholmod_start(&common_);
  common_.print = 0;
  common_.supernodal = CHOLMOD_SUPERNODAL;
  common_.final_ll = 1;
  // Supernodes are joined a little more readily than by default: our problems have small ones, on
  // which a call of the BLAS costs more than the zeros that come in.
  common_.nrelax[0] = 8, common_.nrelax[1] = 32, common_.nrelax[2] = 96;
  common_.zrelax[0] = 0.8, common_.zrelax[1] = 0.2, common_.zrelax[2] = 0.1;
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

Eigen::VectorXi CholmodSolver::order(const SparseMatrix& lower, int group, bool quick) {
  const SparseMatrix groups = quotient(lower, group);
  cholmod_sparse G = cholmod_view(groups), A = cholmod_view(lower);
  common_.nmethods = quick ? 0 : 2;  // 0: CHOLMOD's own strategy, AMD and, if need be, METIS
  common_.method[0].ordering = CHOLMOD_METIS;
  common_.method[1].ordering = CHOLMOD_AMD;
  common_.postorder = 1;
  std::vector<int> given = expand(analyzed(cholmod_analyze(&G, &common_)), group);
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_GIVEN;  // and put in postorder, row by row
  return analyzed(cholmod_analyze_p(&A, given.data(), nullptr, 0, &common_));
}

// Takes the factor; returns its order.
Eigen::VectorXi CholmodSolver::analyzed(cholmod_factor* factor) {
  free_factor();
  L_ = factor;
  if (L_ == nullptr) throw std::bad_alloc();
  return Eigen::Map<const Eigen::VectorXi>(static_cast<const int*>(L_->Perm),
                                           static_cast<Eigen::Index>(L_->n));
}

void CholmodSolver::analyze(const SparseMatrix& lower) {
  cholmod_sparse A = cholmod_view(lower);
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_NATURAL;
  common_.postorder = 0;  // `order` has done it: then the matrix is used in place, without a copy
  analyzed(cholmod_analyze(&A, &common_));
}

bool CholmodSolver::factorize(const SparseMatrix& lower) {
  cholmod_sparse A = cholmod_view(lower);
  const OneThread one_thread(threads_);
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
