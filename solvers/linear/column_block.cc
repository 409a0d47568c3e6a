#include "solvers/linear/column_block.h"

#include "geometry/core/simd_block.h"
#include "geometry/core/simd_dispatch.h"

namespace deformlab {
namespace {

DEFORMLAB_SIMD_DISPATCH
double dot4(const double* x, const double* y, std::ptrdiff_t n) {
  SimdBlock even = {}, odd = {};
  std::ptrdiff_t c = 0;
  for (; c + 1 < n; c += 2, x += 8, y += 8) {
    even += simd_block(x).v * simd_block(y).v;
    odd += simd_block(x + 4).v * simd_block(y + 4).v;
  }
  if (c < n) even += simd_block(x).v * simd_block(y).v;
  even += odd;
  return (even[0] + even[1]) + (even[2] + even[3]);
}

DEFORMLAB_SIMD_DISPATCH
void axpy4(double s, const double* x, double* y, std::ptrdiff_t n) {
  for (std::ptrdiff_t i = 0; i < 4 * n; ++i) y[i] += s * x[i];
}

DEFORMLAB_SIMD_DISPATCH
void xpay4(const double* x, double s, double* y, std::ptrdiff_t n) {
  for (std::ptrdiff_t i = 0; i < 4 * n; ++i) y[i] = x[i] + s * y[i];
}

DEFORMLAB_SIMD_DISPATCH
void product4(const int* begin, const int* row, const double* value, std::ptrdiff_t n,
              const double* x, double* y) {
  for (std::ptrdiff_t c = 0; c < n; ++c) {
    const SimdBlock xc = simd_block(x + 4 * c).v;
    SimdBlock sum = value[begin[c]] * xc;
    for (int k = begin[c] + 1; k < begin[c + 1]; ++k) {
      const std::ptrdiff_t at = 4 * std::ptrdiff_t(row[k]);
      sum += value[k] * simd_block(x + at).v;
      simd_block(y + at).v += value[k] * xc;
    }
    simd_block(y + 4 * c).v += sum;
  }
}

}  // namespace

void gather(const Eigen::VectorXd& x, int d, ColumnBlock& block) {
  block.topRows(d) = Eigen::Map<const Eigen::MatrixXd>(x.data(), d, block.cols());
}

void scatter(const ColumnBlock& block, int d, Eigen::VectorXd& x) {
  Eigen::Map<Eigen::MatrixXd>(x.data(), d, block.cols()) = block.topRows(d);
}

double dot(const ColumnBlock& x, const ColumnBlock& y) {
  return dot4(x.data(), y.data(), x.cols());
}

void add_scaled(double s, const ColumnBlock& x, ColumnBlock& y) {
  axpy4(s, x.data(), y.data(), x.cols());
}

void add_to_scaled(const ColumnBlock& x, double s, ColumnBlock& y) {
  xpay4(x.data(), s, y.data(), x.cols());
}

void add_product(const SparseMatrix& lower, const ColumnBlock& x, ColumnBlock& y) {
  product4(lower.outerIndexPtr(), lower.innerIndexPtr(), lower.valuePtr(), lower.cols(), x.data(),
           y.data());
}

}  // namespace deformlab
