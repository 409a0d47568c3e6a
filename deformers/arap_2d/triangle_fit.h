#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <vector>

namespace deformlab {

/// The fit of step two in closed form (Igarashi et al. 2005, section 4.2.1). Points are complex
/// numbers x + iy. The similar triangle that fits the intermediate one best is the one at rest
/// times s = Σ_c conj(p_c − c̄) v_c' / Σ_c |p_c − c̄|², c̄ the mean of its corners; of the congruent
/// one only the rotation R = s / |s| is needed.
class TriangleFit {
 public:
  TriangleFit() = default;
  ///   p  #V rest positions [length]; F  3×#F; weights  #F
  TriangleFit(const Eigen::VectorXcd& p, const Eigen::Matrix3Xi& F, const Eigen::VectorXd& weights);

  /// s of every triangle of positions z: linear in z, 0 for a translation, 1 for the rest shape.
  Eigen::VectorXcd similarities(const Eigen::VectorXcd& z) const;

  /// R from s_f = a + Σ_l (re + i im)(f, l) μ_l; re and im are #F × #μ. A triangle that is shrunk
  /// to a point keeps the rotation that it had.
  void fit(std::complex<double> a, const Eigen::ArrayXXd& re, const Eigen::ArrayXXd& im,
           const Eigen::VectorXcd& mu);
  /// R from positions z.
  void fit(const Eigen::VectorXcd& z);
  void reset();  ///< R = 1

  /// b = −f₀/2 of Eq. 16: what the fitted triangles ask of each vertex.
  void assemble(Eigen::VectorXcd& b) const;

  /// 2×3·#F corners of the congruent triangles where those of z are [length].
  Eigen::Matrix2Xd corners(const Eigen::VectorXcd& z) const;

  Eigen::Index size() const { return R_re_.size(); }  ///< #F
  std::complex<double> R(Eigen::Index f) const { return {R_re_[f], R_im_[f]}; }

 private:
  static constexpr int kBlock = 64;  // triangles at a time, for the processor's wide registers
  struct Block {
    alignas(16) std::array<double, kBlock> re, im;
  };
  // d_c = 3 w (p_c − c̄) of the first two corners; the third is their negative sum.
  struct Triangle {
    std::array<int, 3> v;
    double x0, y0, x1, y1;
    double to_s;  // 1 / (3 w Σ_c |p_c − c̄|²)
    double to_p;  // 1 / (3 w)
  };

  void normalize(Eigen::Index first, Eigen::Index count, const Block& s);

  std::vector<Triangle> triangles_;
  Eigen::ArrayXd R_re_, R_im_;
};

}  // namespace deformlab
