#include <algorithm>
#include <utility>

#include "geometry/core/simd_block.h"
#include "geometry/core/simd_dispatch.h"
#include "solvers/linear/panel_cholesky.h"

namespace deformlab {
namespace {

using Complex = std::complex<double>;
using Panel = PanelCholesky<double>::Panel;
using ComplexPanel = PanelCholesky<Complex>::Panel;

// A row of a right-hand side: four real numbers, or one complex number (re, im).
using Four = SimdBlock;
using Pair = double __attribute__((vector_size(16)));

template <class Row>
DEFORMLAB_INLINE InMemory<Row>& at(double* z, std::ptrdiff_t row) {
  return reinterpret_cast<InMemory<Row>*>(z)[row];
}

// iz = i z, which only products with complex numbers need.
template <class Row>
DEFORMLAB_INLINE void turn(const double*, const Row&, Row&) {}
DEFORMLAB_INLINE void turn(const Complex*, const Pair& z, Pair& iz) { iz = Pair{-z[1], z[0]}; }

// sum = a z, sum += a z and sum −= a z.
template <class Row>
DEFORMLAB_INLINE void set_product(Row& sum, double a, const Row& z, const Row&) {
  sum = a * z;
}
template <class Row>
DEFORMLAB_INLINE void add_product(Row& sum, double a, const Row& z, const Row&) {
  sum += a * z;
}
template <class Row>
DEFORMLAB_INLINE void subtract_product(Row& sum, double a, const Row& z, const Row&) {
  sum -= a * z;
}
DEFORMLAB_INLINE void set_product(Pair& sum, const Complex& a, const Pair& z, const Pair& iz) {
  sum = a.real() * z + a.imag() * iz;
}
DEFORMLAB_INLINE void add_product(Pair& sum, const Complex& a, const Pair& z, const Pair& iz) {
  sum += a.real() * z + a.imag() * iz;
}
DEFORMLAB_INLINE void subtract_product(Pair& sum, const Complex& a, const Pair& z, const Pair& iz) {
  sum -= a.real() * z + a.imag() * iz;
}

DEFORMLAB_INLINE double real(double a) { return a; }
DEFORMLAB_INLINE double real(const Complex& a) { return a.real(); }
DEFORMLAB_INLINE double conjugate(double a) { return a; }
DEFORMLAB_INLINE Complex conjugate(const Complex& a) { return {a.real(), -a.imag()}; }

// Solves L y = z in a panel's columns, and subtracts from the rows below what these contribute.
template <int width, class Row, class AnyPanel, class Scalar>
DEFORMLAB_INLINE void forward(const AnyPanel& panel, const int* row, const Scalar* value,
                              double* z) {
  Row y[width], iy[width];
  for (int c = 0; c < width; ++c) {
    Row sum = at<Row>(z, panel.first + c).v;
    for (int b = 0; b < c; ++b) subtract_product(sum, *value++, y[b], iy[b]);
    y[c] = real(*value++) * sum;
    turn(value, y[c], iy[c]);
    at<Row>(z, panel.first + c).v = y[c];
  }
  for (int r = 0; r < panel.rows; ++r, value += width) {
    Row sum;
    set_product(sum, value[0], y[0], iy[0]);
    for (int c = 1; c < width; ++c) add_product(sum, value[c], y[c], iy[c]);
    at<Row>(z, row[r]).v -= sum;
  }
}

// Subtracts from y what the rows below a panel's triangle contribute in its columns.
template <int width, class Row, class Scalar>
DEFORMLAB_INLINE void subtract_rows(int rows, const int* row, const Scalar* value, double* z,
                                    Row* y) {
  Row ix;
  for (int r = 0; r < rows; ++r, value += width) {
    const Row x = at<Row>(z, row[r]).v;
    turn(value, x, ix);
    for (int c = 0; c < width; ++c) subtract_product(y[c], conjugate(value[c]), x, ix);
  }
}

// The same for complex panels of four columns, without the shuffles that products of complex
// numbers need: sums up the products with the real and the imaginary parts of z.
template <int width>
requires(width == 4) DEFORMLAB_INLINE
    void subtract_rows(int rows, const int* row, const Complex* value, double* z, Pair* y) {
  SimdBlock re[2] = {}, im[2] = {};
  for (int r = 0; r < rows; ++r, value += width) {
    const Pair x = at<Pair>(z, row[r]).v;
    for (int half = 0; half < 2; ++half) {
      const SimdBlock v = simd_block(reinterpret_cast<const double*>(value + 2 * half)).v;
      re[half] += x[0] * v;
      im[half] += x[1] * v;
    }
  }
  for (int c = 0; c < width; ++c) {
    const int half = c / 2, i = 2 * (c % 2);
    y[c] -= Pair{re[half][i] + im[half][i + 1], im[half][i] - re[half][i + 1]};
  }
}

// Solves Lᴴ z = y in a panel's columns.
template <int width, class Row, class AnyPanel, class Scalar>
DEFORMLAB_INLINE void backward(const AnyPanel& panel, const int* row, const Scalar* triangle,
                               double* z) {
  const Scalar* value = triangle + width * (width + 1) / 2;
  Row y[width], iy;
  for (int c = 0; c < width; ++c) y[c] = at<Row>(z, panel.first + c).v;
  subtract_rows<width>(panel.rows, row, value, z, y);
  for (int c = width - 1; c >= 0; --c) {
    y[c] *= real(triangle[c * (c + 1) / 2 + c]);
    turn(triangle, y[c], iy);
    for (int b = 0; b < c; ++b) {
      subtract_product(y[b], conjugate(triangle[c * (c + 1) / 2 + b]), y[c], iy);
    }
    at<Row>(z, panel.first + c).v = y[c];
  }
}

template <class Row, class AnyPanel, class Scalar>
DEFORMLAB_INLINE void forward_all(const AnyPanel* begin, const AnyPanel* end, const int* rows,
                                  const Scalar* values, double* z) {
  for (const AnyPanel* p = begin; p != end; ++p) {
    const int* row = rows + p->index;
    const Scalar* value = values + p->values;
    switch (p->width) {
      case 1:
        forward<1, Row>(*p, row, value, z);
        break;
      case 2:
        forward<2, Row>(*p, row, value, z);
        break;
      case 3:
        forward<3, Row>(*p, row, value, z);
        break;
      default:
        forward<4, Row>(*p, row, value, z);
    }
  }
}

template <class Row, class AnyPanel, class Scalar>
DEFORMLAB_INLINE void backward_all(const AnyPanel* begin, const AnyPanel* end, const int* rows,
                                   const Scalar* values, double* z) {
  for (const AnyPanel* p = end; p != begin;) {
    --p;
    const int* row = rows + p->index;
    const Scalar* value = values + p->values;
    switch (p->width) {
      case 1:
        backward<1, Row>(*p, row, value, z);
        break;
      case 2:
        backward<2, Row>(*p, row, value, z);
        break;
      case 3:
        backward<3, Row>(*p, row, value, z);
        break;
      default:
        backward<4, Row>(*p, row, value, z);
    }
  }
}

DEFORMLAB_SIMD_DISPATCH
void solve_fours(const Panel* begin, const Panel* end, const int* rows, const double* values,
                 double* z) {
  forward_all<Four>(begin, end, rows, values, z);
  backward_all<Four>(begin, end, rows, values, z);
}

DEFORMLAB_SIMD_DISPATCH
void forward_pairs(const Panel* begin, const Panel* end, const int* rows, const double* values,
                   double* z) {
  forward_all<Pair>(begin, end, rows, values, z);
}

DEFORMLAB_SIMD_DISPATCH
void backward_pairs(const Panel* begin, const Panel* end, const int* rows, const double* values,
                    double* z) {
  backward_all<Pair>(begin, end, rows, values, z);
}

DEFORMLAB_SIMD_DISPATCH
void forward_pairs(const ComplexPanel* begin, const ComplexPanel* end, const int* rows,
                   const Complex* values, double* z) {
  forward_all<Pair>(begin, end, rows, values, z);
}

DEFORMLAB_SIMD_DISPATCH
void backward_pairs(const ComplexPanel* begin, const ComplexPanel* end, const int* rows,
                    const Complex* values, double* z) {
  backward_all<Pair>(begin, end, rows, values, z);
}

double* numbers(Eigen::VectorXcd& z) { return reinterpret_cast<double*>(z.data()); }

}  // namespace

template <>
void PanelCholesky<double>::solve(ColumnBlock& Z) const {
  solve_fours(panels_.data(), panels_.data() + panels_.size(), rows_.data(), values_.data(),
              Z.data());
}

template <class Scalar>
void PanelCholesky<Scalar>::solve_lower(Eigen::VectorXcd& z) const {
  forward_pairs(panels_.data(), panels_.data() + panels_.size(), rows_.data(), values_.data(),
                numbers(z));
}

template <class Scalar>
void PanelCholesky<Scalar>::solve_upper(Eigen::VectorXcd& z) const {
  backward_pairs(panels_.data(), panels_.data() + panels_.size(), rows_.data(), values_.data(),
                 numbers(z));
}

// A column of L contributes to those on the way from it to the root of the elimination tree, so
// that only the ways from the entries of b are visited. They merge where they meet.
template <class Scalar>
SparseColumn PanelCholesky<Scalar>::solve_lower(const SparseColumn& b,
                                                Eigen::VectorXcd& zeros) const {
  std::vector<int> ways;  // the next panel of each way
  for (SparseColumn::InnerIterator it(b); it; ++it) {
    zeros[it.index()] = it.value();
    ways.push_back(panel_of_[it.index()]);
  }
  SparseColumn result(b.size());
  const auto end = static_cast<int>(panels_.size());
  for (int p; !ways.empty() && (p = std::ranges::min(ways)) < end;) {
    const Panel& panel = panels_[p];
    forward_pairs(&panel, &panel + 1, rows_.data(), values_.data(), numbers(zeros));
    for (int c = panel.first; c < panel.first + panel.width; ++c) {
      result.insertBack(c) = std::exchange(zeros[c], 0);
    }
    const int next = panel.rows > 0 ? panel_of_[rows_[panel.index]] : end;
    std::ranges::replace(ways, p, next);
  }
  return result;
}

template void PanelCholesky<double>::solve_lower(Eigen::VectorXcd&) const;
template void PanelCholesky<Complex>::solve_lower(Eigen::VectorXcd&) const;
template void PanelCholesky<double>::solve_upper(Eigen::VectorXcd&) const;
template void PanelCholesky<Complex>::solve_upper(Eigen::VectorXcd&) const;
template SparseColumn PanelCholesky<double>::solve_lower(const SparseColumn&,
                                                         Eigen::VectorXcd&) const;
template SparseColumn PanelCholesky<Complex>::solve_lower(const SparseColumn&,
                                                          Eigen::VectorXcd&) const;

}  // namespace deformlab
