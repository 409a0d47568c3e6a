#include "deformers/arap_2d/triangle_fit.h"

#include <algorithm>

#include "geometry/core/simd_block.h"

namespace deformlab {
namespace {

constexpr double kCollapsed = 1e-8;  // a smaller |s| has no direction

// A complex number in one register.
using Pair = double __attribute__((vector_size(16)));

InMemory<Pair>& at(std::complex<double>& z) { return reinterpret_cast<InMemory<Pair>&>(z); }
Pair at(const std::complex<double>& z) { return reinterpret_cast<const InMemory<Pair>&>(z).v; }
Pair turned(const Pair& z) { return Pair{-z[1], z[0]}; }  // i z

}  // namespace

TriangleFit::TriangleFit(const Eigen::VectorXcd& p, const Eigen::Matrix3Xi& F,
                         const Eigen::VectorXd& weights) {
  for (Eigen::Index f = 0; f < F.cols(); ++f) {
    const Eigen::Vector3cd corners = p(F.col(f));
    const Eigen::Vector3cd d = corners.array() - corners.mean();
    const double w = 3 * weights[f];
    triangles_.push_back({{F(0, f), F(1, f), F(2, f)},
                          w * d[0].real(),
                          w * d[0].imag(),
                          w * d[1].real(),
                          w * d[1].imag(),
                          1 / (w * d.squaredNorm()),
                          1 / w});
  }
  R_re_.resize(F.cols());
  R_im_.resize(F.cols());
  reset();
}

void TriangleFit::reset() {
  R_re_.setOnes();
  R_im_.setZero();
}

void TriangleFit::normalize(Eigen::Index first, Eigen::Index count, const Block& s) {
  using Values = Eigen::Array<double, kBlock, 1>;
  const Eigen::Map<const Values, Eigen::Aligned16> re(s.re.data()), im(s.im.data());
  const Values square = re * re + im * im, factor = square.sqrt().inverse();
  for (Eigen::Index i = 0; i < count; ++i) {
    const bool turned = square[i] > kCollapsed * kCollapsed;
    R_re_[first + i] = turned ? re[i] * factor[i] : R_re_[first + i];
    R_im_[first + i] = turned ? im[i] * factor[i] : R_im_[first + i];
  }
}

void TriangleFit::fit(const Eigen::VectorXcd& z, Eigen::VectorXcd& b) {
  Block s;
  s.re.fill(0);
  s.im.fill(0);
  b.setZero();
  for (Eigen::Index first = 0; first < size(); first += kBlock) {
    const Eigen::Index count = std::min<Eigen::Index>(kBlock, size() - first);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Triangle& t = triangles_[first + i];
      const Pair u = at(z[t.v[0]]) - at(z[t.v[2]]), v = at(z[t.v[1]]) - at(z[t.v[2]]);
      const Pair sum = t.x0 * u + t.x1 * v - turned(t.y0 * u + t.y1 * v);
      s.re[i] = t.to_s * sum[0];
      s.im[i] = t.to_s * sum[1];
    }
    normalize(first, count, s);
    assemble(first, count, b);
  }
}

void TriangleFit::assemble(Eigen::VectorXcd& b) const {
  b.setZero();
  assemble(0, size(), b);
}

void TriangleFit::assemble(Eigen::Index first, Eigen::Index count, Eigen::VectorXcd& b) const {
  for (Eigen::Index f = first; f < first + count; ++f) {
    const Triangle& t = triangles_[f];
    const Pair d0{t.x0, t.y0}, d1{t.x1, t.y1};
    const Pair e0 = R_re_[f] * d0 + R_im_[f] * turned(d0);
    const Pair e1 = R_re_[f] * d1 + R_im_[f] * turned(d1);
    at(b[t.v[0]]).v += e0;
    at(b[t.v[1]]).v += e1;
    at(b[t.v[2]]).v -= e0 + e1;
  }
}

Eigen::Matrix2Xd TriangleFit::corners(const Eigen::VectorXcd& z) const {
  Eigen::Matrix2Xd result(2, 3 * size());
  for (Eigen::Index f = 0; f < size(); ++f) {
    const Triangle& t = triangles_[f];
    const std::complex<double> d0(t.x0, t.y0), d1(t.x1, t.y1);
    const std::complex<double> mean = (z[t.v[0]] + z[t.v[1]] + z[t.v[2]]) / 3.0;
    const std::array<std::complex<double>, 3> d{d0, d1, -(d0 + d1)};
    for (int c = 0; c < 3; ++c) {
      const std::complex<double> corner = mean + R(f) * (t.to_p * d[c]);
      result.col(3 * f + c) << corner.real(), corner.imag();
    }
  }
  return result;
}

}  // namespace deformlab
