#include "solvers/gauss_newton/linearization/free_columns.h"

namespace deformlab {

FreeColumns::FreeColumns(const Problem& problem)
    : dimension_(problem.x.dimension()), first_(problem.x.first), rank_(problem.x.X.cols(), -1) {
  for (int j = 0; j < problem.x.nodes(); ++j) {
    for (int c = first_[j]; c < first_[j + 1] && !problem.fixed[j]; ++c) rank_[c] = count_++;
  }
}

void FreeColumns::reorder(const std::vector<int>& order) {
  std::vector<int> position(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) position[order[i]] = static_cast<int>(i);
  for (int& rank : rank_) {
    if (rank >= 0) rank = position[rank];
  }
}

std::vector<int> columns_read(const Energy& energy, const FreeColumns& columns) {
  std::vector<int> counts, result;
  for (int a = 0; a < energy.arity(); ++a) counts.push_back(energy.argument(a).count);
  result.reserve(std::size_t(energy.size()) * columns_of_element(energy));
  std::size_t a = 0;
  for (const int j : energy.nodes()) {
    for (int c = 0; c < counts[a]; ++c) result.push_back(columns.first()[j] + c);
    a = a + 1 < counts.size() ? a + 1 : 0;
  }
  return result;
}

}  // namespace deformlab
