#include "solvers/linear/panel_cholesky.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/core/simd_block.h"
#include "geometry/core/simd_dispatch.h"
#include "solvers/linear/linear_solver.h"

namespace deformlab {
namespace {

using Complex = std::complex<double>;

constexpr int kWidth = 4;  // the most columns in a panel

template <class Scalar>
constexpr int kNumbers = sizeof(Scalar) / sizeof(double);  // 2 for complex numbers

double conjugate(double a) { return a; }
Complex conjugate(const Complex& a) { return std::conj(a); }

// Subtracts the contribution of an earlier panel from the rows of the current one, which have four
// entries each.
//   blocks  1 for real entries and 2 for complex ones
//   terms   the real numbers in a row of the earlier panel: `blocks` for each of its columns
//   coefficient  terms × 4·blocks numbers: what each of them is multiplied by
template <int terms, int blocks>
DEFORMLAB_INLINE void subtract_rows(const int* row, int rows, const double* value,
                                    const double* coefficient, const int* position, double* work) {
  SimdBlock c[terms][blocks];
  for (int t = 0; t < terms; ++t) {
    for (int b = 0; b < blocks; ++b) c[t][b] = simd_block(coefficient + 4 * (blocks * t + b)).v;
  }
  for (int r = 0; r < rows; ++r, value += terms) {
    double* own = work + 4 * blocks * std::ptrdiff_t(position[row[r]]);
    for (int b = 0; b < blocks; ++b) {
      SimdBlock sum = value[0] * c[0][b];
      for (int t = 1; t < terms; ++t) sum += value[t] * c[t][b];
      simd_block(own + 4 * b).v -= sum;
    }
  }
}

template <int blocks>
DEFORMLAB_INLINE void subtract_rows(int width, const int* row, int rows, const double* value,
                                    const double* coefficient, const int* position, double* work) {
  switch (width) {
    case 1:
      return subtract_rows<blocks, blocks>(row, rows, value, coefficient, position, work);
    case 2:
      return subtract_rows<2 * blocks, blocks>(row, rows, value, coefficient, position, work);
    case 3:
      return subtract_rows<3 * blocks, blocks>(row, rows, value, coefficient, position, work);
    default:
      return subtract_rows<kWidth * blocks, blocks>(row, rows, value, coefficient, position, work);
  }
}

DEFORMLAB_SIMD_DISPATCH
void subtract_panel(int width, const int* row, int rows, const double* value,
                    const double* coefficient, const int* position, double* work) {
  subtract_rows<1>(width, row, rows, value, coefficient, position, work);
}

DEFORMLAB_SIMD_DISPATCH
void subtract_complex_panel(int width, const int* row, int rows, const double* value,
                            const double* coefficient, const int* position, double* work) {
  subtract_rows<2>(width, row, rows, value, coefficient, position, work);
}

void subtract_panel(int width, const int* row, int rows, const Complex* value,
                    const Complex* coefficient, const int* position, Complex* work) {
  subtract_complex_panel(width, row, rows, reinterpret_cast<const double*>(value),
                         reinterpret_cast<const double*>(coefficient), position,
                         reinterpret_cast<double*>(work));
}

}  // namespace

// The rows of a column of L are those of the matrix and those of the panels whose first row it is.
// A column joins the panel to its left if the zeros that this adds take no longer than a panel of
// its own.
template <class Scalar>
void PanelCholesky<Scalar>::find_panels(const Matrix& lower) {
  const auto n = static_cast<int>(lower.cols());
  panels_.clear(), rows_.clear();
  std::vector<int> first_child(n, -1), next_child, met(n, -1), rows;
  std::vector<int> lowest;  // the first row of each panel
  for (int c = 0; c < n; ++c) {
    rows.clear();
    const auto meet = [&](int row) {
      if (row > c && met[row] != c) met[row] = c, rows.push_back(row);
    };
    const auto meet_all = [&](const Panel& panel) {
      for (int r = 0; r < panel.rows; ++r) meet(rows_[panel.index + r]);
    };
    for (int k = lower.outerIndexPtr()[c]; k < lower.outerIndexPtr()[c + 1]; ++k) {
      meet(lower.innerIndexPtr()[k]);
    }
    for (int p = first_child[c]; p >= 0; p = next_child[p]) meet_all(panels_[p]);
    bool joins = false;
    if (!panels_.empty()) {
      const Panel& left = panels_.back();
      if (lowest.back() == c) {
        meet_all(left);
        const auto all = static_cast<int>(rows.size());
        joins = left.width < kWidth && left.width * (all + 1 - left.rows) <= all + 1;
      } else if (lowest.back() < n) {
        next_child.back() = std::exchange(first_child[lowest.back()], int(panels_.size()) - 1);
      }
    }
    if (joins) {
      rows_.resize(panels_.back().index);
      ++panels_.back().width;
      panels_.back().rows = static_cast<int>(rows.size());
    } else {
      panels_.push_back({c, 1, static_cast<int>(rows.size()), rows_.size(), 0});
      lowest.push_back(n);
      next_child.push_back(-1);
    }
    lowest.back() = rows.empty() ? n : *std::min_element(rows.begin(), rows.end());
    rows_.insert(rows_.end(), rows.begin(), rows.end());
  }
}

// A bucket sort: goes through the rows in ascending order, and gives each to the panels that have
// it.
template <class Scalar>
void PanelCholesky<Scalar>::sort_rows(int n) {
  std::vector<int> begin(n + 1, 0), panel_of(rows_.size());
  for (const int row : rows_) ++begin[row + 1];
  for (int r = 0; r < n; ++r) begin[r + 1] += begin[r];
  for (int p = 0; p < static_cast<int>(panels_.size()); ++p) {
    for (int r = 0; r < panels_[p].rows; ++r) panel_of[begin[rows_[panels_[p].index + r]]++] = p;
  }
  std::vector<std::size_t> next;
  for (const Panel& panel : panels_) next.push_back(panel.index);
  for (int row = 0, i = 0; row < n; ++row) {
    for (; i < begin[row]; ++i) rows_[next[panel_of[i]]++] = row;
  }
}

template <class Scalar>
void PanelCholesky<Scalar>::lay_out_values() {
  std::size_t size = 0;
  for (Panel& panel : panels_) {
    panel.values = size;
    size += panel.width * (panel.width + 1) / 2 + std::size_t(panel.rows) * panel.width;
  }
  values_.resize(size);
}

template <class Scalar>
struct PanelCholesky<Scalar>::Workspace {
  std::vector<int> position;  // of each row among those of the current panel
  // Each panel has a linked list of the panels that contribute to it next: `waiting` is the first
  // one of its list, and `next` is the one after it in the list that it is in.
  std::vector<int> waiting, next;
  std::vector<int> reached;  // for each panel, its first row that has not contributed yet
  std::vector<Scalar> rows;  // the rows of the current panel, four entries each
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;  // pivots
};

// Copies the entries of the matrix in a panel's columns.
template <class Scalar>
void PanelCholesky<Scalar>::load(const Matrix& lower, const Panel& panel, Workspace& w) const {
  const int* row = rows_.data() + panel.index;
  w.rows.assign(4 * std::size_t(panel.width + panel.rows), 0);
  for (int c = 0; c < panel.width; ++c) w.position[panel.first + c] = c;
  for (int r = 0; r < panel.rows; ++r) w.position[row[r]] = panel.width + r;
  for (int c = 0; c < panel.width; ++c) {
    const int* begin = lower.outerIndexPtr() + panel.first + c;
    for (int k = begin[0]; k < begin[1]; ++k) {
      w.rows[4 * w.position[lower.innerIndexPtr()[k]] + c] = lower.valuePtr()[k];
    }
  }
}

// Subtracts what the panel `q` to the left contributes. That panel then waits for the next one to
// which it contributes.
template <class Scalar>
void PanelCholesky<Scalar>::subtract(int q, const Panel& panel, Workspace& w) const {
  const Panel& left = panels_[q];
  const int* row = rows_.data() + left.index;
  const Scalar* value = values_.data() + left.values + left.width * (left.width + 1) / 2;
  const int from = w.reached[q];
  Scalar coefficient[4 * kWidth * kNumbers<Scalar>] = {};
  int to = from;
  for (; to < left.rows && row[to] < panel.first + panel.width; ++to) {
    Scalar* column = coefficient + (row[to] - panel.first);
    for (int i = 0; i < left.width; ++i) {
      const Scalar c = conjugate(value[to * left.width + i]);
      column[4 * kNumbers<Scalar> * i] = c;
      // The imaginary part of an entry is multiplied by i c.
      if constexpr (kNumbers<Scalar> == 2) column[8 * i + 4] = {-c.imag(), c.real()};
    }
  }
  subtract_panel(left.width, row + from, left.rows - from,
                 value + std::ptrdiff_t(from) * left.width, coefficient, w.position.data(),
                 w.rows.data());
  w.reached[q] = to;
  if (to < left.rows) w.next[q] = std::exchange(w.waiting[panel_of_[row[to]]], q);
}

// Computes the factor's entries in a panel. Returns false if a pivot is not positive.
template <class Scalar>
bool PanelCholesky<Scalar>::finish(const Panel& panel, Workspace& w) {
  Scalar* value = values_.data() + panel.values;
  double inverse[kWidth];
  for (int r = 0; r < panel.width + panel.rows; ++r) {
    Scalar* own = w.rows.data() + 4 * std::ptrdiff_t(r);
    for (int c = 0; c < std::min(r, panel.width); ++c) {
      for (int b = 0; b < c; ++b) own[c] -= own[b] * conjugate(w.rows[4 * c + b]);
      own[c] *= inverse[c];
      *value++ = own[c];
    }
    if (r >= panel.width) continue;
    double pivot = std::real(own[r]);
    for (int b = 0; b < r; ++b) pivot -= std::norm(own[b]);
    if (!(pivot > 0)) return false;
    w.smallest = std::min(w.smallest, pivot);
    w.largest = std::max(w.largest, pivot);
    inverse[r] = 1 / std::sqrt(pivot);
    *value++ = inverse[r];
  }
  return true;
}

// A left-looking factorization: goes through the panels from left to right, and subtracts from each
// what those before it contribute.
template <class Scalar>
bool PanelCholesky<Scalar>::compute(const Matrix& lower) {
  const std::size_t n = lower.cols(), count = panels_.size();
  Workspace w{std::vector<int>(n),
              std::vector<int>(count, -1),
              std::vector<int>(count, -1),
              std::vector<int>(count, 0),
              {}};
  panel_of_.resize(n);
  for (std::size_t p = 0; p < count; ++p) {
    std::fill_n(panel_of_.begin() + panels_[p].first, panels_[p].width, static_cast<int>(p));
  }
  for (int p = 0; p < static_cast<int>(count); ++p) {
    load(lower, panels_[p], w);
    for (int q = w.waiting[p], after; q >= 0; q = after) {
      after = w.next[q];
      subtract(q, panels_[p], w);
    }
    if (!finish(panels_[p], w)) return false;
    const int* row = rows_.data() + panels_[p].index;
    if (panels_[p].rows > 0) w.next[p] = std::exchange(w.waiting[panel_of_[row[0]]], p);
  }
  return w.smallest > kSingularRatio * w.largest;
}

template <class Scalar>
bool PanelCholesky<Scalar>::factorize(const Matrix& lower) {
  find_panels(lower);
  sort_rows(static_cast<int>(lower.cols()));
  lay_out_values();
  return compute(lower);
}

template class PanelCholesky<double>;
template class PanelCholesky<std::complex<double>>;

}  // namespace deformlab
