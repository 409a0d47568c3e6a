#include "solvers/column_cholesky.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/clones.h"
#include "geometry/four.h"
#include "solvers/linear_solver.h"

namespace deformlab {
namespace {

constexpr int kWidth = 4;  // of a panel at most

using Panel = ColumnCholesky::Panel;

double* at(double* z, std::ptrdiff_t row) { return z + 4 * row; }

// L y = z.
template <int width>
inline __attribute__((always_inline)) void forward(const Panel& panel, const int* row,
                                                   const double* value, double* z) {
  Four y[width];
  for (int c = 0; c < width; ++c) {
    y[c] = four(at(z, panel.first + c));
    for (int b = 0; b < c; ++b) y[c] -= *value++ * y[b];
    y[c] *= *value++;
    four(at(z, panel.first + c)) = y[c];
  }
  for (int r = 0; r < panel.rows; ++r, value += width) {
    Four sum = value[0] * y[0];
    for (int c = 1; c < width; ++c) sum += value[c] * y[c];
    four(at(z, row[r])) -= sum;
  }
}

// Lᵀ z = y.
template <int width>
inline __attribute__((always_inline)) void backward(const Panel& panel, const int* row,
                                                    const double* triangle, double* z) {
  const double* value = triangle + width * (width + 1) / 2;
  Four y[width];
  for (int c = 0; c < width; ++c) y[c] = four(at(z, panel.first + c));
  for (int r = 0; r < panel.rows; ++r, value += width) {
    const Four x = four(at(z, row[r]));
    for (int c = 0; c < width; ++c) y[c] -= value[c] * x;
  }
  for (int c = width - 1; c >= 0; --c) {
    y[c] *= triangle[c * (c + 1) / 2 + c];
    for (int b = 0; b < c; ++b) y[b] -= triangle[c * (c + 1) / 2 + b] * y[c];
    four(at(z, panel.first + c)) = y[c];
  }
}

DEFORMLAB_CLONES
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

DEFORMLAB_CLONES
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
inline __attribute__((always_inline)) void subtract(const int* row, int rows, const double* value,
                                                    const double* coefficient, const int* place,
                                                    double* work) {
  Four c[width];
  for (int q = 0; q < width; ++q) c[q] = four(coefficient + 4 * q);
  for (int r = 0; r < rows; ++r, value += width) {
    Four sum = value[0] * c[0];
    for (int q = 1; q < width; ++q) sum += value[q] * c[q];
    four(work + 4 * std::ptrdiff_t(place[row[r]])) -= sum;
  }
}

DEFORMLAB_CLONES
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
      const auto below = static_cast<int>(rows.size());
      if (lowest.back() == c) {
        meet_all(left);
        const auto all = static_cast<int>(rows.size());
        joins = left.width < kWidth && left.width * (all + 1 - left.rows) <= all + 1;
      } else if (lowest.back() < n) {
        next_child.back() = std::exchange(first_child[lowest.back()], int(panels_.size()) - 1);
      }
      (void)below;
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

// From left to right, each panel less what those before it add to its rows.
bool ColumnCholesky::compute(const SparseMatrix& lower) {
  const auto n = static_cast<int>(lower.cols());
  std::size_t size = 0;
  std::vector<int> panel_of(n), place(n), waiting(panels_.size(), -1), next(panels_.size(), -1);
  std::vector<int> reached(panels_.size(), 0);  // the first row of a panel not dealt with yet
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    Panel& panel = panels_[p];
    panel.values = size;
    size += panel.width * (panel.width + 1) / 2 + std::size_t(panel.rows) * panel.width;
    for (int c = 0; c < panel.width; ++c) panel_of[panel.first + c] = static_cast<int>(p);
  }
  values_.resize(size);
  std::vector<double> work;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (int p = 0; p < static_cast<int>(panels_.size()); ++p) {
    const Panel& panel = panels_[p];
    const int width = panel.width, *row = rows_.data() + panel.index;
    work.assign(4 * std::size_t(width + panel.rows), 0);
    for (int c = 0; c < width; ++c) place[panel.first + c] = c;
    for (int r = 0; r < panel.rows; ++r) place[row[r]] = width + r;
    for (int c = 0; c < width; ++c) {
      for (int k = lower.outerIndexPtr()[panel.first + c];
           k < lower.outerIndexPtr()[panel.first + c + 1]; ++k) {
        work[4 * place[lower.innerIndexPtr()[k]] + c] = lower.valuePtr()[k];
      }
    }
    for (int q = waiting[p], after; q >= 0; q = after) {
      after = next[q];
      const Panel& left = panels_[q];
      const int* left_row = rows_.data() + left.index;
      const double* left_value = values_.data() + left.values + left.width * (left.width + 1) / 2;
      const int from = reached[q];
      double coefficient[4 * kWidth] = {};
      int to = from;
      for (; to < left.rows && left_row[to] < panel.first + width; ++to) {
        for (int i = 0; i < left.width; ++i) {
          coefficient[4 * i + left_row[to] - panel.first] = left_value[to * left.width + i];
        }
      }
      subtract_panel(left.width, left_row + from, left.rows - from,
                     left_value + std::ptrdiff_t(from) * left.width, coefficient, place.data(),
                     work.data());
      reached[q] = to;
      if (to < left.rows) next[q] = std::exchange(waiting[panel_of[left_row[to]]], q);
    }
    double* value = values_.data() + panel.values;
    double inverse[kWidth];
    double* triangle = value;
    for (int r = 0; r < width; ++r) {
      double* own = work.data() + 4 * r;
      for (int c = 0; c < r; ++c) {
        for (int b = 0; b < c; ++b) own[c] -= own[b] * work[4 * c + b];
        own[c] *= inverse[c];
        *value++ = own[c];
      }
      for (int b = 0; b < r; ++b) own[r] -= own[b] * own[b];
      if (!(own[r] > 0)) return false;
      smallest = std::min(smallest, own[r]);
      largest = std::max(largest, own[r]);
      inverse[r] = 1 / std::sqrt(own[r]);
      *value++ = inverse[r];
    }
    (void)triangle;
    for (int r = 0; r < panel.rows; ++r) {
      double* own = work.data() + 4 * (width + r);
      for (int c = 0; c < width; ++c) {
        for (int b = 0; b < c; ++b) own[c] -= own[b] * work[4 * c + b];
        own[c] *= inverse[c];
        *value++ = own[c];
      }
    }
    if (panel.rows > 0) next[p] = std::exchange(waiting[panel_of[row[0]]], p);
  }
  return smallest > kSingularRatio * largest;
}

bool ColumnCholesky::factorize(const SparseMatrix& lower) {
  find_panels(lower);
  sort_rows(static_cast<int>(lower.cols()));
  return compute(lower);
}

void ColumnCholesky::solve(Columns4& z) const {
  const Panel *begin = panels_.data(), *end = begin + panels_.size();
  forward_all(begin, end, rows_.data(), values_.data(), z.data());
  backward_all(begin, end, rows_.data(), values_.data(), z.data());
}

}  // namespace deformlab
