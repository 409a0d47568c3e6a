#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <vector>

namespace deformlab {

/// The fitting in closed form (Igarashi et al. 2005, section 4.2.1). Points x + iy are complex
/// numbers, and p_c are the corners of a triangle at rest, with mean c̄. The similar triangle that
/// fits the intermediate triangle v_c' best is the triangle at rest times
///   s = Σ_c conj(p_c − c̄) v_c' / Σ_c |p_c − c̄|².
/// The congruent triangle is the triangle at rest times the rotation R = s / |s|.
class TriangleFit {
 public:
  TriangleFit() = default;
  ///   p  #V rest positions [length]
  ///   F  3×#F triangles
  ///   weights  #F
  TriangleFit(const Eigen::VectorXcd& p, const Eigen::Matrix3Xi& F, const Eigen::VectorXd& weights);

  /// Sets R from the positions z (#V), and b as `assemble` does. A triangle that has shrunk to a
  /// point keeps the rotation that it had.
  void fit(const Eigen::VectorXcd& z, Eigen::VectorXcd& b);
  void reset();  ///< sets R = 1

  /// Sets b (#V) to −f₀/2 of Eq. 16, the right-hand side of step two.
  void assemble(Eigen::VectorXcd& b) const;

  /// The corners (2×3·#F) of the congruent triangles, each with the centre that its triangle has in
  /// the positions z [length].
  Eigen::Matrix2Xd corners(const Eigen::VectorXcd& z) const;

  Eigen::Index size() const { return R_re_.size(); }  ///< #F
  std::complex<double> R(Eigen::Index f) const { return {R_re_[f], R_im_[f]}; }

 private:
  static constexpr int kBlock = 64;  // triangles per block, so that the compiler vectorizes loops
  struct Block {
    alignas(16) std::array<double, kBlock> re, im;
  };
  // A triangle at rest, with its weight w.
  struct Triangle {
    std::array<int, 3> v;
    double x0, y0, x1, y1;  // 3 w (p_c − c̄) for c = 0, 1; the one of c = 2 is their negative sum
    double to_s;            // 1 / (3 w Σ_c |p_c − c̄|²)
    double to_p;            // 1 / (3 w)
  };

  void normalize(Eigen::Index first, Eigen::Index count, const Block& s);
  void assemble(Eigen::Index first, Eigen::Index count, Eigen::VectorXcd& b) const;

  std::vector<Triangle> triangles_;
  Eigen::ArrayXd R_re_, R_im_;
};

}  // namespace deformlab
