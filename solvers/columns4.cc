#include "solvers/columns4.h"

#include "geometry/clones.h"
#include "geometry/four.h"

namespace deformlab {
namespace {

DEFORMLAB_CLONES
double dot4(const double* x, const double* y, std::ptrdiff_t n) {
  Four even = {}, odd = {};
  std::ptrdiff_t c = 0;
  for (; c + 1 < n; c += 2, x += 8, y += 8) {
    even += four(x) * four(y);
    odd += four(x + 4) * four(y + 4);
  }
  if (c < n) even += four(x) * four(y);
  even += odd;
  return (even[0] + even[1]) + (even[2] + even[3]);
}

DEFORMLAB_CLONES
void axpy4(double s, const double* x, double* y, std::ptrdiff_t n) {
  for (std::ptrdiff_t i = 0; i < 4 * n; ++i) y[i] += s * x[i];
}

DEFORMLAB_CLONES
void xpay4(const double* x, double s, double* y, std::ptrdiff_t n) {
  for (std::ptrdiff_t i = 0; i < 4 * n; ++i) y[i] = x[i] + s * y[i];
}

DEFORMLAB_CLONES
void product4(const int* begin, const int* row, const double* value, std::ptrdiff_t n,
              const double* x, double* y) {
  for (std::ptrdiff_t c = 0; c < n; ++c) {
    const Four xc = four(x + 4 * c);
    Four sum = value[begin[c]] * xc;
    for (int k = begin[c] + 1; k < begin[c + 1]; ++k) {
      const std::ptrdiff_t at = 4 * std::ptrdiff_t(row[k]);
      sum += value[k] * four(x + at);
      four(y + at) += value[k] * xc;
    }
    four(y + 4 * c) += sum;
  }
}

}  // namespace

double dot(const Columns4& x, const Columns4& y) { return dot4(x.data(), y.data(), x.cols()); }

void add_scaled(double s, const Columns4& x, Columns4& y) {
  axpy4(s, x.data(), y.data(), x.cols());
}

void add_to_scaled(const Columns4& x, double s, Columns4& y) {
  xpay4(x.data(), s, y.data(), x.cols());
}

void add_product(const SparseMatrix& lower, const Columns4& x, Columns4& y) {
  product4(lower.outerIndexPtr(), lower.innerIndexPtr(), lower.valuePtr(), lower.cols(), x.data(),
           y.data());
}

}  // namespace deformlab
