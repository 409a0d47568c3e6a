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

// Solves Lᴴ z = y in a panel's columns.
template <int width, class Row, class AnyPanel, class Scalar>
DEFORMLAB_INLINE void backward(const AnyPanel& panel, const int* row, const Scalar* triangle,
                               double* z) {
  const Scalar* value = triangle + width * (width + 1) / 2;
  Row y[width], ix, iy;
  for (int c = 0; c < width; ++c) y[c] = at<Row>(z, panel.first + c).v;
  for (int r = 0; r < panel.rows; ++r, value += width) {
    const Row x = at<Row>(z, row[r]).v;
    turn(value, x, ix);
    for (int c = 0; c < width; ++c) subtract_product(y[c], conjugate(value[c]), x, ix);
  }
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
DEFORMLAB_INLINE void solve_all(const AnyPanel* begin, const AnyPanel* end, const int* rows,
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
  solve_all<Four>(begin, end, rows, values, z);
}

void solve_pairs(const Panel* begin, const Panel* end, const int* rows, const double* values,
                 double* z) {
  solve_all<Pair>(begin, end, rows, values, z);
}

void solve_pairs(const ComplexPanel* begin, const ComplexPanel* end, const int* rows,
                 const Complex* values, double* z) {
  solve_all<Pair>(begin, end, rows, values, z);
}

}  // namespace

template <>
void PanelCholesky<double>::solve(ColumnBlock& Z) const {
  solve_fours(panels_.data(), panels_.data() + panels_.size(), rows_.data(), values_.data(),
              Z.data());
}

template <class Scalar>
void PanelCholesky<Scalar>::solve(Eigen::VectorXcd& z) const {
  solve_pairs(panels_.data(), panels_.data() + panels_.size(), rows_.data(), values_.data(),
              reinterpret_cast<double*>(z.data()));
}

template void PanelCholesky<double>::solve(Eigen::VectorXcd&) const;
template void PanelCholesky<Complex>::solve(Eigen::VectorXcd&) const;

}  // namespace deformlab
