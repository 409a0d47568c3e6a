#include "deformers/arap_2d/triangle_fit.h"

#include <algorithm>

namespace deformlab {
namespace {

constexpr double kCollapsed = 1e-8;  // a smaller |s| has no direction

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

void TriangleFit::fit(std::complex<double> a, const Eigen::ArrayXXd& re, const Eigen::ArrayXXd& im,
                      const Eigen::VectorXcd& mu) {
  Block s;
  for (Eigen::Index first = 0; first < size(); first += kBlock) {
    const Eigen::Index count = std::min<Eigen::Index>(kBlock, size() - first);
    s.re.fill(a.real());
    s.im.fill(a.imag());
    for (Eigen::Index l = 0; l < mu.size(); ++l) {
      const double x = mu[l].real(), y = mu[l].imag();
      const double *u = &re(first, l), *v = &im(first, l);
      for (Eigen::Index i = 0; i < count; ++i) {
        s.re[i] += x * u[i] - y * v[i];
        s.im[i] += x * v[i] + y * u[i];
      }
    }
    normalize(first, count, s);
  }
}

void TriangleFit::fit(const Eigen::VectorXcd& z) {
  Block s;
  s.re.fill(0);
  s.im.fill(0);
  for (Eigen::Index first = 0; first < size(); first += kBlock) {
    const Eigen::Index count = std::min<Eigen::Index>(kBlock, size() - first);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Triangle& t = triangles_[first + i];
      const std::complex<double> u = z[t.v[0]] - z[t.v[2]], v = z[t.v[1]] - z[t.v[2]];
      s.re[i] = t.to_s * (t.x0 * u.real() + t.y0 * u.imag() + t.x1 * v.real() + t.y1 * v.imag());
      s.im[i] = t.to_s * (t.x0 * u.imag() - t.y0 * u.real() + t.x1 * v.imag() - t.y1 * v.real());
    }
    normalize(first, count, s);
  }
}

Eigen::VectorXcd TriangleFit::similarities(const Eigen::VectorXcd& z) const {
  Eigen::VectorXcd s(size());
  for (Eigen::Index f = 0; f < size(); ++f) {
    const Triangle& t = triangles_[f];
    const std::complex<double> d0(t.x0, t.y0), d1(t.x1, t.y1);
    s[f] = t.to_s *
           (std::conj(d0) * (z[t.v[0]] - z[t.v[2]]) + std::conj(d1) * (z[t.v[1]] - z[t.v[2]]));
  }
  return s;
}

void TriangleFit::assemble(Eigen::VectorXcd& b) const {
  b.setZero();
  auto* sum = reinterpret_cast<double*>(b.data());
  const auto add = [sum](int v, double x, double y) {
    sum[2 * std::ptrdiff_t(v)] += x;
    sum[2 * std::ptrdiff_t(v) + 1] += y;
  };
  for (Eigen::Index f = 0; f < size(); ++f) {
    const Triangle& t = triangles_[f];
    const double c = R_re_[f], s = R_im_[f];
    const double x0 = c * t.x0 - s * t.y0, y0 = c * t.y0 + s * t.x0;
    const double x1 = c * t.x1 - s * t.y1, y1 = c * t.y1 + s * t.x1;
    add(t.v[0], x0, y0);
    add(t.v[1], x1, y1);
    add(t.v[2], -(x0 + x1), -(y0 + y1));
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
