#include "solvers/linear/panel_cholesky.h"

#include <cholmod.h>

#include <algorithm>
#include <array>
#include <new>
#include <type_traits>

#include "solvers/linear/linear_solver.h"

namespace deformlab {
namespace {

constexpr int kWidth = 4;  // of a panel at most: so many columns' sums stay in registers

// One entry of the right-hand side, (re, im), and i times it.
using Pair = Eigen::Array2d;
Pair quarter_turn(const Pair& z) { return {-z[1], z[0]}; }

Pair times(double a, const Pair& z, const Pair&) { return a * z; }
Pair times(std::complex<double> a, const Pair& z, const Pair& iz) {
  return a.real() * z + a.imag() * iz;
}
// A Hermitian matrix has a real diagonal, but for rounding, which CHOLMOD takes for a fault.
void make_diagonal_real(Eigen::SparseMatrix<double>&) {}
void make_diagonal_real(Eigen::SparseMatrix<std::complex<double>>& lower) {
  for (int c = 0; c < lower.cols(); ++c) lower.coeffRef(c, c) = lower.coeff(c, c).real();
}

double conjugate(double a) { return a; }
std::complex<double> conjugate(std::complex<double> a) { return std::conj(a); }

auto at(double* z, int i) { return Eigen::Map<Pair, Eigen::Aligned16>(z + 2 * std::ptrdiff_t(i)); }

// CHOLMOD's workspace and factor, for as long as the panels are filled.
struct Cholmod {
  Cholmod() {
    cholmod_start(&common);
    common.print = 0;
    common.try_catch = 1;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_NATURAL;
    common.postorder = 0;
    common.supernodal = CHOLMOD_SIMPLICIAL;  // of so sparse a factor the faster one
    common.final_ll = 1;
  }
  ~Cholmod() {
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  template <class Matrix>
  bool factorize(const Matrix& lower) {
    using Scalar = typename Matrix::Scalar;
    cholmod_sparse A{};
    A.nrow = A.ncol = lower.cols();
    A.nzmax = lower.nonZeros();
    A.p = const_cast<int*>(lower.outerIndexPtr());
    A.i = const_cast<int*>(lower.innerIndexPtr());
    A.x = const_cast<Scalar*>(lower.valuePtr());
    A.stype = -1;  // lower triangle
    A.itype = CHOLMOD_INT;
    A.xtype = std::is_same_v<Scalar, double> ? CHOLMOD_REAL : CHOLMOD_COMPLEX;
    A.dtype = CHOLMOD_DOUBLE;
    A.sorted = A.packed = 1;
    L = cholmod_analyze(&A, &common);
    if (L != nullptr) cholmod_factorize(&A, L, &common);
    if (L == nullptr || common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    return common.status == CHOLMOD_OK && cholmod_rcond(L, &common) > kSingularRatio;
  }

  cholmod_common common;
  cholmod_factor* L = nullptr;
};

}  // namespace

// A column of L as CHOLMOD has it: the diagonal first, then by ascending row.
template <class Scalar>
struct PanelCholesky<Scalar>::Column {
  const int* rows;
  const Scalar* entries;
  int count;
};

template <class Scalar>
bool PanelCholesky<Scalar>::factorize(Matrix lower) {
  make_diagonal_real(lower);
  panels_.clear(), rows_.clear(), values_.clear();
  Cholmod cholmod;
  if (!cholmod.factorize(lower)) return false;
  const cholmod_factor& L = *cholmod.L;
  const auto *begin = static_cast<int*>(L.p), *count = static_cast<int*>(L.nz);
  std::vector<Column> columns;
  for (std::size_t c = 0; c < L.n; ++c) {
    columns.push_back(
        {static_cast<int*>(L.i) + begin[c], static_cast<Scalar*>(L.x) + begin[c], count[c]});
  }
  const int n = static_cast<int>(L.n);
  for (int first = 0, width; first < n; first += width) {
    width = 1;
    while (width < kWidth && first + width < n && joins(width, columns.data() + first)) ++width;
    add_panel(first, width, columns.data() + first);
  }
  return true;
}

// Whether the next column may follow `width` ones in their panel: it has all rows that they have
// below it, and the zeros that its other rows bring into them take no longer than a panel of its
// own.
template <class Scalar>
bool PanelCholesky<Scalar>::joins(int width, const Column* columns) {
  const Column &left = columns[width - 1], &right = columns[width];
  const bool parent = left.count > 1 && left.rows[1] == right.rows[0];
  return parent && width * (right.count + 1 - left.count) <= right.count;
}

template <class Scalar>
void PanelCholesky<Scalar>::add_panel(int first, int width, const Column* columns) {
  const Column& last = columns[width - 1];
  panels_.push_back({first, width, last.count - 1, rows_.size(), values_.size()});
  std::array<int, kWidth> next{};  // entry of each column
  const auto entry = [&](int column, int row) {
    const Column& c = columns[column];
    const bool there = next[column] < c.count && c.rows[next[column]] == row;
    return there ? c.entries[next[column]++] : Scalar(0);
  };
  for (int r = 0; r < width; ++r) {
    for (int c = 0; c < r; ++c) values_.push_back(entry(c, first + r));
    values_.push_back(1.0 / entry(r, first + r));
  }
  for (int r = 1; r < last.count; ++r) {
    rows_.push_back(last.rows[r]);
    for (int c = 0; c < width; ++c) values_.push_back(entry(c, last.rows[r]));
  }
}

// L y = z.
template <class Scalar>
template <int width>
void PanelCholesky<Scalar>::forward(const Panel& panel, double* z) const {
  const Scalar* value = values_.data() + panel.values;
  std::array<Pair, width> y, iy;
  for (int c = 0; c < width; ++c) {
    Pair sum = at(z, panel.first + c);
    for (int b = 0; b < c; ++b) sum -= times(*value++, y[b], iy[b]);
    y[c] = std::real(*value++) * sum;
    iy[c] = quarter_turn(y[c]);
    at(z, panel.first + c) = y[c];
  }
  const int* row = rows_.data() + panel.index;
  for (int r = 0; r < panel.rows; ++r, value += width) {
    Pair sum = times(value[0], y[0], iy[0]);
    for (int c = 1; c < width; ++c) sum += times(value[c], y[c], iy[c]);
    at(z, row[r]) -= sum;
  }
}

// Lᴴ z = y.
template <class Scalar>
template <int width>
void PanelCholesky<Scalar>::backward(const Panel& panel, double* z) const {
  const Scalar* triangle = values_.data() + panel.values;
  const Scalar* value = triangle + width * (width + 1) / 2;
  std::array<Pair, width> y;
  for (int c = 0; c < width; ++c) y[c] = at(z, panel.first + c);
  const int* row = rows_.data() + panel.index;
  for (int r = 0; r < panel.rows; ++r, value += width) {
    const Pair x = at(z, row[r]), ix = quarter_turn(x);
    for (int c = 0; c < width; ++c) y[c] -= times(conjugate(value[c]), x, ix);
  }
  for (int c = width - 1; c >= 0; --c) {
    y[c] *= std::real(triangle[c * (c + 1) / 2 + c]);
    const Pair iy = quarter_turn(y[c]);
    for (int b = 0; b < c; ++b) y[b] -= times(conjugate(triangle[c * (c + 1) / 2 + b]), y[c], iy);
    at(z, panel.first + c) = y[c];
  }
}

template <class Scalar>
void PanelCholesky<Scalar>::solve(Eigen::VectorXcd& z) const {
  auto* x = reinterpret_cast<double*>(z.data());
  for (const Panel& panel : panels_) {
    switch (panel.width) {
      case 1:
        forward<1>(panel, x);
        break;
      case 2:
        forward<2>(panel, x);
        break;
      case 3:
        forward<3>(panel, x);
        break;
      default:
        forward<kWidth>(panel, x);
    }
  }
  for (auto panel = panels_.rbegin(); panel != panels_.rend(); ++panel) {
    switch (panel->width) {
      case 1:
        backward<1>(*panel, x);
        break;
      case 2:
        backward<2>(*panel, x);
        break;
      case 3:
        backward<3>(*panel, x);
        break;
      default:
        backward<kWidth>(*panel, x);
    }
  }
}

template class PanelCholesky<double>;
template class PanelCholesky<std::complex<double>>;

}  // namespace deformlab
