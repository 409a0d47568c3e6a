#include "solvers/normal_equations.h"

#include <algorithm>

namespace deformlab {

namespace {

// One entry of an element's JᵀJ.
double square(const Linearization::Part& part, int e, int p, int q) {
  const std::ptrdiff_t first = std::ptrdiff_t(e) * part.energy->jacobian_columns();
  return part.square() ? part.JtJ(p, first + q) : part.J.col(first + p).dot(part.J.col(first + q));
}

}  // namespace

NormalEquations::NormalEquations(const Stage& stage) : Linearization(stage) {
  assemble();
  assemble_structure();
}

// visit(p, q, row, column) for every pair of entries p, q of an element whose place is free and in
// H's lower triangle. A term that is separable but for its loss couples no two coordinates.
template <class Visit>
void NormalEquations::for_each_pair(const Part& part, int e, Visit&& visit) const {
  const int d = dimension(), n = part.energy->jacobian_columns();
  const bool apart = part.energy->structure() == Structure::kSeparable;
  const int* column = part.column.data() + std::ptrdiff_t(e) * (n / d);
  for (int p = 0; p < n; ++p) {
    const int row = place(p % d, column[p / d]);
    for (int q = apart ? p % d : 0; q < n && row >= 0; q += apart ? d : 1) {
      const int col = place(q % d, column[q / d]);
      if (col >= 0 && row >= col) visit(p, q, row, col);
    }
  }
}

void NormalEquations::assemble_structure() {
  Triplets triplets;
  std::vector<int> column(free_columns());  // of X, by rank
  for (int c = 0; c < columns(); ++c) {
    if (rank()[c] >= 0) column[rank()[c]] = c;
  }
  for (int c = 0; c < A().outerSize(); ++c) {
    for (SparseMatrix::InnerIterator it(A(), c); it; ++it) {
      for (int i = 0; i < dimension(); ++i) {
        const auto [col, row] = std::minmax<int>({place(i, column[c]), place(i, column[it.row()])});
        triplets.emplace_back(row, col, it.value());
      }
    }
  }
  for (const Part& part : parts()) {
    if (part.structure() == Structure::kSeparable) continue;
    const bool constant = part.structure() == Structure::kLinear;
    for (int e = 0; e < part.energy->size(); ++e) {
      for_each_pair(part, e, [&](int p, int q, int row, int col) {
        triplets.emplace_back(row, col, constant ? part.weight * square(part, e, p, q) : 0);
      });
    }
  }
  for (int i = 0; i < unknowns(); ++i) triplets.emplace_back(i, i, 0);  // for dampings
  H_.resize(unknowns(), unknowns());
  H_.setFromTriplets(triplets.begin(), triplets.end());
  constant_ = Eigen::Map<const Eigen::VectorXd>(H_.valuePtr(), H_.nonZeros());
  find_targets();
}

void NormalEquations::find_targets() {
  targets_.assign(parts().size(), {});
  for (std::size_t i = 0; i < parts().size(); ++i) {
    const Part& part = parts()[i];
    if (part.structure() != Structure::kNonlinear) continue;
    for (int e = 0; e < part.energy->size(); ++e) {
      for_each_pair(part, e, [&](int, int, int row, int col) {
        const int* begin = H_.innerIndexPtr() + H_.outerIndexPtr()[col];
        const int* end = H_.innerIndexPtr() + H_.outerIndexPtr()[col + 1];
        const int* found = std::lower_bound(begin, end, row);
        targets_[i].push_back(static_cast<int>(found - H_.innerIndexPtr()));
      });
    }
  }
}

void NormalEquations::reorder(const Eigen::VectorXi& order) {
  std::vector<int> place_of(order.size());
  for (int i = 0; i < order.size(); ++i) place_of[order[i]] = i;
  for (int& place : place_) {
    if (place >= 0) place = place_of[place];
  }
  assemble_structure();
}

void NormalEquations::linearized() {
  Eigen::Map<Eigen::VectorXd>(H_.valuePtr(), H_.nonZeros()) = constant_;
  for (std::size_t i = 0; i < parts().size(); ++i) {
    if (!targets_[i].empty()) add_JtJ(parts()[i], targets_[i]);
  }
}

void NormalEquations::add_JtJ(const Part& part, const std::vector<int>& targets) {
  double* values = H_.valuePtr();
  const int* target = targets.data();
  for (int e = 0; e < part.energy->size(); ++e) {
    for_each_pair(part, e, [&](int p, int q, int, int) {
      values[*target++] += part.weight * square(part, e, p, q);
    });
  }
}

}  // namespace deformlab
