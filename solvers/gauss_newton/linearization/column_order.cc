#include "solvers/gauss_newton/linearization/column_order.h"

#include <algorithm>
#include <cstdint>
#include <new>

#include "solvers/linear/cholmod_workspace.h"

namespace deformlab {
namespace {

std::uint64_t scramble(std::uint64_t x) {
  x = (x + 1) * 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  return x ^ (x >> 31);
}

// The class of each rank. Neighbouring columns that have the same entries share a class. A sum of
// hashes stands for the set of entries; if two sets ever collide, the order is a little worse.
std::vector<int> classes(const NodeBlocks& A, const std::vector<int>& rank, int n) {
  std::vector<std::uint64_t> sum(n, 0);
  A.for_each([&](int p, int q, double) {
    if (rank[p] < 0 || rank[q] < 0) return;
    sum[rank[p]] += scramble(rank[q]);
    if (p != q) sum[rank[q]] += scramble(rank[p]);
  });
  std::vector<int> result(n, 0);
  for (int i = 1; i < n; ++i) result[i] = result[i - 1] + (sum[i] != sum[i - 1]);
  return result;
}

// A minimum-degree order of a symmetric structure, sorted by a postorder of the elimination tree.
std::vector<int> minimum_degree(const SparseMatrix& lower) {
  CholmodWorkspace cholmod;
  cholmod.use_ordering(CHOLMOD_AMD, true);
  cholmod.common.supernodal = CHOLMOD_SIMPLICIAL;
  cholmod_sparse A = cholmod_view(lower);
  cholmod_factor* factor = cholmod_analyze(&A, &cholmod.common);
  if (factor == nullptr) throw std::bad_alloc();
  const int* perm = static_cast<const int*>(factor->Perm);
  std::vector<int> order(perm, perm + factor->n);
  cholmod_free_factor(&factor, &cholmod.common);
  return order;
}

}  // namespace

std::vector<int> column_order(const NodeBlocks& A, const std::vector<int>& rank, int n) {
  if (n == 0) return {};
  const std::vector<int> class_of = classes(A, rank, n);
  std::vector<int> begin;  // first rank of each class
  for (int i = 0; i < n; ++i) {
    if (i == 0 || class_of[i] != class_of[i - 1]) begin.push_back(i);
  }
  begin.push_back(n);
  std::vector<std::pair<int, int>> entries;
  std::vector<int> next(begin.size(), 0);
  A.for_each([&](int p, int q, double) {
    const int r = std::max(rank[p], rank[q]), c = std::min(rank[p], rank[q]);
    if (c < 0 || begin[class_of[r]] != r || begin[class_of[c]] != c) return;
    entries.emplace_back(class_of[r], class_of[c]);
    ++next[class_of[c] + 1];
  });
  SparseMatrix lower(std::ssize(begin) - 1, std::ssize(begin) - 1);
  lower.resizeNonZeros(std::ssize(entries));
  for (Eigen::Index c = 0; c < lower.cols(); ++c) next[c + 1] += next[c];
  std::copy(next.begin(), next.end(), lower.outerIndexPtr());
  for (const auto& [row, column] : entries) lower.innerIndexPtr()[next[column]++] = row;
  for (Eigen::Index c = 0; c < lower.cols(); ++c) {
    std::sort(lower.innerIndexPtr() + lower.outerIndexPtr()[c],
              lower.innerIndexPtr() + lower.outerIndexPtr()[c + 1]);
  }
  lower.coeffs().setOnes();
  std::vector<int> order;
  for (const int group : minimum_degree(lower)) {
    for (int i = begin[group]; i < begin[group + 1]; ++i) order.push_back(i);
  }
  return order;
}

}  // namespace deformlab
