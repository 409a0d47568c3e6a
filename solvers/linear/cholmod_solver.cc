#include "solvers/linear/cholmod_solver.h"

#include <new>
#include <utility>
#include <vector>

#include "solvers/linear/one_thread.h"

namespace deformlab {
namespace {

// The structure over groups of consecutive rows. Ordering the groups is much faster, and causes no
// more fill if the rows of a group have almost the same neighbours.
SparseMatrix quotient(const SparseMatrix& lower, int group) {
  const Eigen::Index n = lower.cols() / group;
  std::vector<int> last(n, -1);  // for each row, the last column with an entry in it
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
  cholmod_common& common = cholmod_.common;
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.final_ll = 1;
  // Supernodes are merged a little more readily than by default: those of our problems are small,
  // so that a call of the BLAS costs more than the zeros that merging adds.
  common.nrelax[0] = 8, common.nrelax[1] = 32, common.nrelax[2] = 96;
  common.zrelax[0] = 0.8, common.zrelax[1] = 0.2, common.zrelax[2] = 0.1;
}

CholmodSolver::~CholmodSolver() {
  cholmod_free_factor(&L_, &cholmod_.common);
  for (cholmod_dense** dense : {&x_, &Y_, &E_}) cholmod_free_dense(dense, &cholmod_.common);
}

Eigen::VectorXi CholmodSolver::order(const SparseMatrix& lower, int group, bool quick) {
  cholmod_sparse A = cholmod_view(lower);
  cholmod_common& common = cholmod_.common;
  common.nmethods = quick ? 0 : 2;  // 0: CHOLMOD's strategy is AMD and, if that is poor, METIS
  common.method[0].ordering = CHOLMOD_METIS;
  common.method[1].ordering = CHOLMOD_AMD;
  common.postorder = 1;
  if (group == 1) return take(cholmod_analyze(&A, &common));
  const SparseMatrix groups = quotient(lower, group);
  cholmod_sparse G = cholmod_view(groups);
  std::vector<int> given = expand(take(cholmod_analyze(&G, &common)), group);
  cholmod_.use_ordering(CHOLMOD_GIVEN, true);  // sorts the rows by a postorder
  return take(cholmod_analyze_p(&A, given.data(), nullptr, 0, &common));
}

// Keeps the factor and returns its order.
Eigen::VectorXi CholmodSolver::take(cholmod_factor* factor) {
  cholmod_free_factor(&L_, &cholmod_.common);
  L_ = factor;
  if (L_ == nullptr) throw std::bad_alloc();
  return Eigen::Map<const Eigen::VectorXi>(static_cast<const int*>(L_->Perm),
                                           static_cast<Eigen::Index>(L_->n));
}

void CholmodSolver::analyze(const SparseMatrix& lower) {
  cholmod_sparse A = cholmod_view(lower);
  // `order` has sorted by a postorder already. Without another one, CHOLMOD does not copy the
  // matrix.
  cholmod_.use_ordering(CHOLMOD_NATURAL, false);
  take(cholmod_analyze(&A, &cholmod_.common));
}

bool CholmodSolver::factorize(const SparseMatrix& lower) {
  cholmod_sparse A = cholmod_view(lower);
  cholmod_common& common = cholmod_.common;
  const OneThread one_thread(threads_);
  cholmod_factorize(&A, L_, &common);
  if (common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  return common.status == CHOLMOD_OK && cholmod_rcond(L_, &common) > kSingularRatio;
}

void CholmodSolver::solve(const Eigen::VectorXd& b, Eigen::VectorXd& delta) {
  cholmod_dense B{};
  B.nrow = B.nzmax = B.d = b.size();
  B.ncol = 1;
  B.x = const_cast<double*>(b.data());
  B.xtype = CHOLMOD_REAL;
  B.dtype = CHOLMOD_DOUBLE;
  if (!cholmod_solve2(CHOLMOD_A, L_, &B, nullptr, &x_, nullptr, &Y_, &E_, &cholmod_.common)) {
    throw std::bad_alloc();
  }
  delta = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(x_->x), b.size());
}

long CholmodSolver::nonzeros() const { return static_cast<long>(cholmod_.common.lnz); }

std::unique_ptr<LinearSolver> make_cholmod(int threads) {
  return std::make_unique<CholmodSolver>(threads);
}

}  // namespace deformlab
