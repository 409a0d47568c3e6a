#include "solvers/linear/column_cholesky.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/core/simd_block.h"
#include "geometry/core/simd_dispatch.h"
#include "solvers/linear/linear_solver.h"

namespace deformlab {
namespace {

constexpr int kWidth = 4;  // of a panel at most

using Panel = ColumnCholesky::Panel;

double* at(double* z, std::ptrdiff_t row) { return z + 4 * row; }

// L y = z.
template <int width>
DEFORMLAB_INLINE void forward(const Panel& panel, const int* row, const double* value, double* z) {
  SimdBlock y[width];
  for (int c = 0; c < width; ++c) {
    y[c] = simd_block(at(z, panel.first + c));
    for (int b = 0; b < c; ++b) y[c] -= *value++ * y[b];
    y[c] *= *value++;
    simd_block(at(z, panel.first + c)) = y[c];
  }
  for (int r = 0; r < panel.rows; ++r, value += width) {
    SimdBlock sum = value[0] * y[0];
    for (int c = 1; c < width; ++c) sum += value[c] * y[c];
    simd_block(at(z, row[r])) -= sum;
  }
}

// Lᵀ z = y.
template <int width>
DEFORMLAB_INLINE void backward(const Panel& panel, const int* row, const double* triangle,
                               double* z) {
  const double* value = triangle + width * (width + 1) / 2;
  SimdBlock y[width];
  for (int c = 0; c < width; ++c) y[c] = simd_block(at(z, panel.first + c));
  for (int r = 0; r < panel.rows; ++r, value += width) {
    const SimdBlock x = simd_block(at(z, row[r]));
    for (int c = 0; c < width; ++c) y[c] -= value[c] * x;
  }
  for (int c = width - 1; c >= 0; --c) {
    y[c] *= triangle[c * (c + 1) / 2 + c];
    for (int b = 0; b < c; ++b) y[b] -= triangle[c * (c + 1) / 2 + b] * y[c];
    simd_block(at(z, panel.first + c)) = y[c];
  }
}

DEFORMLAB_SIMD_DISPATCH
void forward_all(const Panel* begin, const Panel* end, const int* rows, const double* values,
                 double* z) {
  for (const Panel* p = begin; p != end; ++p) {
    const int* row = rows + p->index;
    const double* value = values + p->values;
    switch (p->width) {
      case 1:
        forward<1>(*p, row, value, z);
        break;
      case 2:
        forward<2>(*p, row, value, z);
        break;
      case 3:
        forward<3>(*p, row, value, z);
        break;
      default:
        forward<kWidth>(*p, row, value, z);
    }
  }
}

DEFORMLAB_SIMD_DISPATCH
void backward_all(const Panel* begin, const Panel* end, const int* rows, const double* values,
                  double* z) {
  for (const Panel* p = end; p != begin;) {
    --p;
    const int* row = rows + p->index;
    const double* value = values + p->values;
    switch (p->width) {
      case 1:
        backward<1>(*p, row, value, z);
        break;
      case 2:
        backward<2>(*p, row, value, z);
        break;
      case 3:
        backward<3>(*p, row, value, z);
        break;
      default:
        backward<kWidth>(*p, row, value, z);
    }
  }
}

// The rows of a panel under work, four entries each, less what an earlier panel adds to them.
//   coefficient  width × 4: the earlier panel's entries in the rows of the new one's columns
template <int width>
DEFORMLAB_INLINE void subtract(const int* row, int rows, const double* value,
                               const double* coefficient, const int* place, double* work) {
  SimdBlock c[width];
  for (int q = 0; q < width; ++q) c[q] = simd_block(coefficient + 4 * q);
  for (int r = 0; r < rows; ++r, value += width) {
    SimdBlock sum = value[0] * c[0];
    for (int q = 1; q < width; ++q) sum += value[q] * c[q];
    simd_block(work + 4 * std::ptrdiff_t(place[row[r]])) -= sum;
  }
}

DEFORMLAB_SIMD_DISPATCH
void subtract_panel(int width, const int* row, int rows, const double* value,
                    const double* coefficient, const int* place, double* work) {
  switch (width) {
    case 1:
      return subtract<1>(row, rows, value, coefficient, place, work);
    case 2:
      return subtract<2>(row, rows, value, coefficient, place, work);
    case 3:
      return subtract<3>(row, rows, value, coefficient, place, work);
    default:
      return subtract<kWidth>(row, rows, value, coefficient, place, work);
  }
}

}  // namespace

// The rows of a column are its own in the matrix and those of the panels whose first row it is. It
// joins the panel to its left where the zeros that come in take no longer than a panel of its own.
void ColumnCholesky::find_panels(const SparseMatrix& lower) {
  const auto n = static_cast<int>(lower.cols());
  panels_.clear(), rows_.clear();
  std::vector<int> first_child(n, -1), next_child, met(n, -1), rows;
  std::vector<int> lowest;  // row of each panel
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

// By buckets: rows in turn, handed to the panels that have them.
void ColumnCholesky::sort_rows(int n) {
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

// Where the entries of each panel begin.
void ColumnCholesky::place_values() {
  std::size_t size = 0;
  for (Panel& panel : panels_) {
    panel.values = size;
    size += panel.width * (panel.width + 1) / 2 + std::size_t(panel.rows) * panel.width;
  }
  values_.resize(size);
}

// What a factorization needs beside its result.
struct ColumnCholesky::Workspace {
  std::vector<int> panel_of;  // of each column
  std::vector<int> place;     // of each row among those of the panel under work
  // The panels that are waited for by a panel, as a list: its first, and who comes after each.
  std::vector<int> waiting, next;
  std::vector<int> reached;  // the first row of a panel that is not dealt with yet
  std::vector<double> rows;  // of the panel under work, four entries each
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;  // pivots
};

// The entries of the matrix in a panel's columns.
void ColumnCholesky::load(const SparseMatrix& lower, const Panel& panel, Workspace& w) const {
  const int* row = rows_.data() + panel.index;
  w.rows.assign(4 * std::size_t(panel.width + panel.rows), 0);
  for (int c = 0; c < panel.width; ++c) w.place[panel.first + c] = c;
  for (int r = 0; r < panel.rows; ++r) w.place[row[r]] = panel.width + r;
  for (int c = 0; c < panel.width; ++c) {
    const int* begin = lower.outerIndexPtr() + panel.first + c;
    for (int k = begin[0]; k < begin[1]; ++k) {
      w.rows[4 * w.place[lower.innerIndexPtr()[k]] + c] = lower.valuePtr()[k];
    }
  }
}

// Less what the panel `q` to the left adds, which then waits for the next one that it reaches.
void ColumnCholesky::subtract(int q, const Panel& panel, Workspace& w) const {
  const Panel& left = panels_[q];
  const int* row = rows_.data() + left.index;
  const double* value = values_.data() + left.values + left.width * (left.width + 1) / 2;
  const int from = w.reached[q];
  double coefficient[4 * kWidth] = {};
  int to = from;
  for (; to < left.rows && row[to] < panel.first + panel.width; ++to) {
    for (int i = 0; i < left.width; ++i) {
      coefficient[4 * i + row[to] - panel.first] = value[to * left.width + i];
    }
  }
  subtract_panel(left.width, row + from, left.rows - from,
                 value + std::ptrdiff_t(from) * left.width, coefficient, w.place.data(),
                 w.rows.data());
  w.reached[q] = to;
  if (to < left.rows) w.next[q] = std::exchange(w.waiting[w.panel_of[row[to]]], q);
}

// The factor's entries of a panel. False where a pivot is not positive.
bool ColumnCholesky::finish(const Panel& panel, Workspace& w) {
  double* value = values_.data() + panel.values;
  double inverse[kWidth];
  for (int r = 0; r < panel.width + panel.rows; ++r) {
    double* own = w.rows.data() + 4 * std::ptrdiff_t(r);
    for (int c = 0; c < std::min(r, panel.width); ++c) {
      for (int b = 0; b < c; ++b) own[c] -= own[b] * w.rows[4 * c + b];
      own[c] *= inverse[c];
      *value++ = own[c];
    }
    if (r >= panel.width) continue;
    for (int b = 0; b < r; ++b) own[r] -= own[b] * own[b];
    if (!(own[r] > 0)) return false;
    w.smallest = std::min(w.smallest, own[r]);
    w.largest = std::max(w.largest, own[r]);
    inverse[r] = 1 / std::sqrt(own[r]);
    *value++ = inverse[r];
  }
  return true;
}

// From left to right, each panel less what those before it add to its rows.
bool ColumnCholesky::compute(const SparseMatrix& lower) {
  const std::size_t n = lower.cols(), count = panels_.size();
  Workspace w{std::vector<int>(n),         std::vector<int>(n),        std::vector<int>(count, -1),
              std::vector<int>(count, -1), std::vector<int>(count, 0), {}};
  for (std::size_t p = 0; p < count; ++p) {
    std::fill_n(w.panel_of.begin() + panels_[p].first, panels_[p].width, static_cast<int>(p));
  }
  for (int p = 0; p < static_cast<int>(count); ++p) {
    load(lower, panels_[p], w);
    for (int q = w.waiting[p], after; q >= 0; q = after) {
      after = w.next[q];
      subtract(q, panels_[p], w);
    }
    if (!finish(panels_[p], w)) return false;
    const int* row = rows_.data() + panels_[p].index;
    if (panels_[p].rows > 0) w.next[p] = std::exchange(w.waiting[w.panel_of[row[0]]], p);
  }
  return w.smallest > kSingularRatio * w.largest;
}

// Finds the branches, and lets their rows above them point to where they are kept apart.
void ColumnCholesky::branch_out() {
  std::vector<int> panel_of(n_), parent, column(n_, -1);
  std::vector<std::size_t> work;
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    std::fill_n(panel_of.begin() + panels_[p].first, panels_[p].width, static_cast<int>(p));
  }
  for (const Panel& panel : panels_) {
    parent.push_back(panel.rows > 0 ? panel_of[rows_[panel.index]] : -1);
    work.push_back(std::size_t(panel.rows + panel.width) * panel.width);
  }
  branches_ = find_branches(parent, work);
  top_.clear();
  for (const auto [begin, end] : branches_.top) {
    for (int p = begin; p < end && !branches_.branches.empty(); ++p) {
      for (int c = 0; c < panels_[p].width; ++c) {
        column[panels_[p].first + c] = static_cast<int>(top_.size());
        top_.push_back(panels_[p].first + c);
      }
    }
  }
  int apart = static_cast<int>(n_);
  for (const auto& branch : branches_.branches) {
    for (const auto [begin, end] : branch) {
      for (std::size_t i = panels_[begin].index; i < panels_[end - 1].index + panels_[end - 1].rows;
           ++i) {
        if (column[rows_[i]] >= 0) rows_[i] = apart + column[rows_[i]];
      }
    }
    apart += static_cast<int>(top_.size());
  }
  z_ = ColumnBlock::Zero(4, apart);
}

bool ColumnCholesky::factorize(const SparseMatrix& lower) {
  n_ = lower.cols();
  find_panels(lower);
  sort_rows(static_cast<int>(n_));
  place_values();
  if (!compute(lower)) return false;
  branch_out();
  return true;
}

void ColumnCholesky::forward(const std::vector<FactorBranches::Range>& ranges) {
  for (const auto [begin, end] : ranges) {
    forward_all(panels_.data() + begin, panels_.data() + end, rows_.data(), values_.data(),
                z_.data());
  }
}

void ColumnCholesky::backward(const std::vector<FactorBranches::Range>& ranges) {
  for (auto range = ranges.rbegin(); range != ranges.rend(); ++range) {
    backward_all(panels_.data() + range->begin, panels_.data() + range->end, rows_.data(),
                 values_.data(), z_.data());
  }
}

void ColumnCholesky::solve(const ColumnBlock& b, ColumnBlock& z, Workers& workers) {
  const auto& branches = branches_.branches;
  const auto count = static_cast<int>(branches.size());
  z_.leftCols(n_) = b;
  z_.rightCols(z_.cols() - n_).setZero();
  workers.each(count, [&](int i) { forward(branches[i]); });
  for (int i = 0; i < count; ++i) {
    for (std::size_t t = 0; t < top_.size(); ++t) {
      simd_block(at(z_.data(), top_[t])) += simd_block(at(apart(i), t));
    }
  }
  forward(branches_.top);
  backward(branches_.top);
  workers.each(count, [&](int i) {
    for (std::size_t t = 0; t < top_.size(); ++t) {
      simd_block(at(apart(i), t)) = simd_block(at(z_.data(), top_[t]));
    }
    backward(branches[i]);
  });
  z = z_.leftCols(n_);
}

}  // namespace deformlab
