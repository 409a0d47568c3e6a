#include "solvers/gauss_newton/step_solvers/normal_matrix.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace deformlab {

NormalMatrix::NormalMatrix(const Linearization& linearization, const Ordering& ordering)
    : position_(linearization.unknowns()) {
  const int d = linearization.columns().dimension();
  const SparseMatrix coupled = linearization.structure_of_others(true);
  const SparseMatrix A =
      linearization.A() + linearization.change_of_A().lower(linearization.columns().count());
  const SparseMatrix uncoupled = A + 0 * linearization.structure_of_others(false);
  std::iota(position_.begin(), position_.end(), 0);
  const Eigen::VectorXi order = ordering(pattern(uncoupled, coupled, d));
  for (int i = 0; i < order.size(); ++i) position_[order[i]] = i;
  H_ = pattern(uncoupled, coupled, d);
  find_targets(linearization);
  const std::size_t linear =
      linearization.derivatives().size() - linearization.nonlinear_parts().size();
  for (std::size_t i = 0; i < linear; ++i) add_JtJ(linearization, i);
  constant_ = Eigen::Map<const Eigen::VectorXd>(H_.valuePtr(), H_.nonZeros());
}

// A ⊗ I_d, with zeros where other terms will be added.
//   uncoupled  A, with an entry for every two columns whose equal coordinates an element couples
//   coupled    not zero for every two columns of which an element couples all coordinates
SparseMatrix NormalMatrix::pattern(const SparseMatrix& uncoupled, const SparseMatrix& coupled,
                                   int d) const {
  std::vector<SparseEntry> entries;
  entries.reserve(d * (uncoupled.nonZeros() + d * coupled.nonZeros()));
  const auto add = [&](Eigen::Index i, Eigen::Index p, Eigen::Index k, Eigen::Index q,
                       double value) {
    const auto [col, row] = std::minmax<int>({position_[d * p + i], position_[d * q + k]});
    entries.push_back({row, col, value});
  };
  std::vector<Eigen::Index> met(uncoupled.cols(), -1);  // for each row, the last column with it
  for (Eigen::Index c = 0; c < uncoupled.cols(); ++c) {
    for (SparseMatrix::InnerIterator it(uncoupled, c); it; ++it) {
      met[it.row()] = c;
      for (int i = 0; i < d; ++i) add(i, it.row(), i, c, it.value());
    }
    for (SparseMatrix::InnerIterator it(coupled, c); it; ++it) {
      if (it.value() == 0) continue;  // a diagonal entry that no such element reads
      for (int i = 0; i < d; ++i) {
        for (int k = 0; k < (it.row() == c ? i : d); ++k) {
          if (i != k || met[it.row()] != c) add(i, it.row(), k, c, 0);
        }
      }
    }
  }
  return sparse_matrix(entries, static_cast<int>(position_.size()));
}

// Calls visit(p, q, row, column) for every two entries p, q of an element that are both unknowns
// and share an entry of H's lower triangle.
template <class Visit>
void NormalMatrix::for_each_pair(const Linearization& linearization, const ElementDerivatives& part,
                                 int e, Visit&& visit) const {
  const FreeColumns& columns = linearization.columns();
  const int d = columns.dimension(), n = part.width();
  const bool couples = part.couples_coordinates();
  const int* column = part.columns_read(e);
  const auto position = [&](int p) {
    const int unknown = columns.unknown(p % d, column[p / d]);
    return unknown < 0 ? -1 : position_[unknown];
  };
  for (int p = 0; p < n; ++p) {
    const int row = position(p);
    for (int q = couples ? 0 : p % d; q < n && row >= 0; q += couples ? 1 : d) {
      const int col = position(q);
      if (col >= 0 && row >= col) visit(p, q, row, col);
    }
  }
}

void NormalMatrix::find_targets(const Linearization& linearization) {
  for (const ElementDerivatives* part : linearization.derivatives()) {
    std::vector<int>& targets = targets_.emplace_back();
    for (int e = 0; e < part->energy().size(); ++e) {
      for_each_pair(linearization, *part, e, [&](int, int, int row, int col) {
        const int* begin = H_.innerIndexPtr() + H_.outerIndexPtr()[col];
        const int* end = H_.innerIndexPtr() + H_.outerIndexPtr()[col + 1];
        const int* found = std::lower_bound(begin, end, row);
        targets.push_back(static_cast<int>(found - H_.innerIndexPtr()));
      });
    }
  }
}

void NormalMatrix::update(const Linearization& linearization) {
  Eigen::Map<Eigen::VectorXd>(H_.valuePtr(), H_.nonZeros()) = constant_;
  const std::size_t all = linearization.derivatives().size();
  for (std::size_t i = all - linearization.nonlinear_parts().size(); i < all; ++i) {
    add_JtJ(linearization, i);
  }
}

void NormalMatrix::add_JtJ(const Linearization& linearization, std::size_t i) {
  const ElementDerivatives& part = *linearization.derivatives()[i];
  double* values = H_.valuePtr();
  const int* target = targets_[i].data();
  for (int e = 0; e < part.energy().size(); ++e) {
    for_each_pair(linearization, part, e, [&](int p, int q, int, int) {
      values[*target++] += part.weight() * part.JtJ(e, p, q);
    });
  }
}

}  // namespace deformlab
