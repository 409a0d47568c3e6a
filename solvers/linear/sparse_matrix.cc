#include "solvers/linear/sparse_matrix.h"

namespace deformlab {

// The entries are sorted by rows, and then by columns with a stable sort.
SparseMatrix sparse_matrix(const std::vector<SparseEntry>& entries, int n) {
  SparseMatrix result(n, n);
  int* begin = result.outerIndexPtr();
  std::vector<int> below(n + 1, 0);
  for (const SparseEntry& e : entries) ++below[e.row + 1], ++begin[e.column + 1];
  for (int c = 0; c < n; ++c) below[c + 1] += below[c], begin[c + 1] += begin[c];
  std::vector<int> by_row(entries.size());
  for (int i = 0; i < static_cast<int>(entries.size()); ++i) by_row[below[entries[i].row]++] = i;
  result.resizeNonZeros(static_cast<Eigen::Index>(entries.size()));
  std::vector<int> next(begin, begin + n);
  for (const int i : by_row) {
    const SparseEntry& e = entries[i];
    result.innerIndexPtr()[next[e.column]] = e.row;
    result.valuePtr()[next[e.column]++] = e.value;
  }
  return result;
}

}  // namespace deformlab
