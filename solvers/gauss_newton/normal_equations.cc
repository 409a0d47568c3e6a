#include "solvers/gauss_newton/normal_equations.h"

#include <algorithm>
#include <utility>

namespace deformlab {
namespace {

using Part = Linearization::Part;

// A term that is Kronecker but for its loss couples no two coordinates.
bool couples_coordinates(const Part& part) {
  return part.energy->structure() != Structure::kKronecker;
}

// One entry of an element's JᵀJ.
double square(const Part& part, int e, int p, int q) {
  const std::ptrdiff_t first = std::ptrdiff_t(e) * part.energy->jacobian_columns();
  return part.square() ? part.JtJ(p, first + q) : part.J.col(first + p).dot(part.J.col(first + q));
}

}  // namespace

NormalEquations::NormalEquations(const Problem& problem) : Linearization(problem) {
  targets_.resize(parts().size());
  assemble();
  full_ = structure_where(couples_coordinates);
}

// A ⊗ I_d, and zeros wherever other terms will add.
SparseMatrix NormalEquations::structure() const {
  const SparseMatrix apart =
      A() + 0 * structure_where([](const Part& p) { return p.loss && !couples_coordinates(p); });
  std::vector<int> column(free_columns());  // of X, by rank
  for (int c = 0; c < columns(); ++c) {
    if (rank()[c] >= 0) column[rank()[c]] = c;
  }
  std::vector<SparseEntry> entries;
  entries.reserve(dimension() * (apart.nonZeros() + dimension() * full_.nonZeros()));
  const auto add = [&](int i, Eigen::Index p, int k, Eigen::Index q, double value) {
    const auto [col, row] = std::minmax<int>({place(i, column[p]), place(k, column[q])});
    entries.push_back({row, col, value});
  };
  std::vector<Eigen::Index> met(free_columns(), -1);  // the column in which a row was met last
  for (Eigen::Index c = 0; c < apart.cols(); ++c) {
    for (SparseMatrix::InnerIterator it(apart, c); it; ++it) {
      met[it.row()] = c;
      for (int i = 0; i < dimension(); ++i) add(i, it.row(), i, c, it.value());
    }
    for (SparseMatrix::InnerIterator it(full_, c); it; ++it) {
      if (it.value() == 0) continue;  // a diagonal that no such element reads
      for (int i = 0; i < dimension(); ++i) {
        for (int k = 0; k < (it.row() == c ? i : dimension()); ++k) {
          if (i != k || met[it.row()] != c) add(i, it.row(), k, c, 0);
        }
      }
    }
  }
  return sparse_matrix(entries, unknowns());
}

// visit(p, q, row, column) for every pair of entries p, q of an element whose place is free and in
// H's lower triangle.
template <class Visit>
void NormalEquations::for_each_pair(const Part& part, int e, Visit&& visit) const {
  const int d = dimension(), n = part.energy->jacobian_columns();
  const bool apart = !couples_coordinates(part);
  const int* column = part.column.data() + std::ptrdiff_t(e) * (n / d);
  for (int p = 0; p < n; ++p) {
    const int row = place(p % d, column[p / d]);
    for (int q = apart ? p % d : 0; q < n && row >= 0; q += apart ? d : 1) {
      const int col = place(q % d, column[q / d]);
      if (col >= 0 && row >= col) visit(p, q, row, col);
    }
  }
}

void NormalEquations::arrange(const Eigen::VectorXi& order) {
  std::vector<int> place_of(order.size());
  for (int i = 0; i < order.size(); ++i) place_of[order[i]] = i;
  for (int& place : place_) {
    if (place >= 0) place = place_of[place];
  }
  H_ = structure();
  find_targets();
  for (std::size_t i = 0; i < parts().size(); ++i) {
    if (parts()[i].structure() == Structure::kLinear) add_JtJ(i);
  }
  constant_ = Eigen::Map<const Eigen::VectorXd>(H_.valuePtr(), H_.nonZeros());
}

void NormalEquations::find_targets() {
  for (std::size_t i = 0; i < parts().size(); ++i) {
    const Part& part = parts()[i];
    if (part.kronecker()) continue;
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

void NormalEquations::linearized() {
  Eigen::Map<Eigen::VectorXd>(H_.valuePtr(), H_.nonZeros()) = constant_;
  for (std::size_t i = 0; i < parts().size(); ++i) {
    if (parts()[i].structure() == Structure::kNonlinear) add_JtJ(i);
  }
}

void NormalEquations::add_JtJ(std::size_t i) {
  const Part& part = parts()[i];
  double* values = H_.valuePtr();
  const int* target = targets_[i].data();
  for (int e = 0; e < part.energy->size(); ++e) {
    for_each_pair(part, e, [&](int p, int q, int, int) {
      values[*target++] += part.weight * square(part, e, p, q);
    });
  }
}

}  // namespace deformlab
