#pragma once

#include <Eigen/QR>

#include "deformers/baselines/baseline.h"
#include "geometry/core/options.h"

namespace deformlab {

/// The options of deformation by radial basis functions.
struct RbfOptions {
  int max_centers = 1000;  ///< the greatest n; the basis takes about 8 n bytes per vertex
  int megabytes = 1000;    ///< a basis that needs more is computed again in each update

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("max_centers", o.max_centers, {.min = 1, .max = 20000},
                "The greatest number of basis functions: one for each handle, or as many spread "
                "over them. Each costs a row of a dense matrix");
    visit.range("megabytes", o.megabytes, {.min = 0},
                "The memory in which the basis at the vertices may be kept between updates [MB]");
  }
};

/// Real-time shape editing using radial basis functions (Botsch and Kobbelt 2005). Space is
/// displaced by d(x) = Σ_j w_j φ(‖x − c_j‖) + p(x) with triharmonic φ(r) = r³, linear p, and Σ_j
/// w_j q(c_j) = 0 for every linear q. Where there are at most max_centers handles, they are the
/// centres, and d interpolates their displacements. Otherwise the centres are a subset of the
/// handles, each the farthest from those chosen before it, and d is the least-squares fit to all
/// handles. The method is linear: it moves features without turning them.
///
/// Where the handles span only a plane, a line or a point, p is linear along it and constant across
/// it, so that a single handle translates the shape. Without a handle the shape stays at rest.
class RbfDeformation final : public Baseline {
 public:
  /// Throws InputError for a shape or options that cannot be used.
  explicit RbfDeformation(Shape rest, const RbfOptions& options = {});

  void reset() override { deformed_ = rest_; }

  const Eigen::Matrix3Xd& centers() const { return centers_; }  ///< 3×n c_j [length]

 private:
  void compile_handles() override;
  void solve(const Eigen::Matrix3Xd& targets, Report& report) override;

  void choose_centers();
  void choose_polynomials();
  void factorize();
  Eigen::MatrixXd basis(const Eigen::Ref<const Eigen::Matrix3Xd>& x) const;
  Eigen::MatrixXd fit(const Eigen::Matrix3Xd& displacements) const;
  Eigen::Matrix3Xd displacement() const;
  Eigen::Matrix3d gradient(const Eigen::Vector3d& x) const;
  bool deform();

  RbfOptions options_;
  Eigen::Matrix3Xd points_;  // 3×#handles at rest: fixed, moved, then points [length]
  double extent_ = 1;        // of the handles [length]; the unit of r and of p's coordinates
  Eigen::Matrix3Xd centers_;
  Eigen::Vector3d origin_;  // of p's coordinates
  Eigen::MatrixXd axes_;    // 3×k directions in which p is linear
  Eigen::HouseholderQR<Eigen::MatrixXd> side_conditions_, fit_;
  Eigen::MatrixXd basis_;  // (n+1+k)×#V, or empty
  Eigen::MatrixXd w_;      // 3×(n+1+k): w_j, then p [length]
};

}  // namespace deformlab
