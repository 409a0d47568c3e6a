#pragma once

#include <Eigen/QR>
#include <map>
#include <string>
#include <vector>

#include "deformers/deformer.h"
#include "geometry/core/options.h"

namespace deformlab {

/// The options of deformation by radial basis functions.
struct RbfOptions {
  int max_centers = 1000;  ///< the greatest n; the basis takes 8 n bytes a vertex
  int megabytes = 1000;  ///< for the basis at all vertices; a larger one is computed anew each time

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("max_centers", o.max_centers, {.min = 1, .max = 20000},
                "The greatest number of basis functions: one for each handle, or as many spread "
                "over them. Each costs a row of a dense matrix");
    visit.range("megabytes", o.megabytes, {.min = 0},
                "The memory in which the basis at the vertices may be kept between updates [MB]");
  }
};

/// Real-time shape editing using radial basis functions (Botsch and Kobbelt 2005): space is
/// displaced by d(x) = Σ_j w_j φ(‖x − c_j‖) + p(x), triharmonic φ(r) = r³, p linear, Σ_j w_j q(c_j)
/// = 0 for every linear q. The centres are the handles where there are no more than max_centers of
/// them, and d interpolates; else a subset, each the farthest from those before it, and d is the
/// least-squares fit to all handles. The method is linear: it moves features without turning them.
///
/// Where the handles span no more than a plane, a line or a point, p is linear along them and
/// constant across: one handle translates, none leaves all at rest.
class RbfDeformation final : public Deformer {
 public:
  /// Throws InputError for a shape or options that cannot be used.
  explicit RbfDeformation(Shape rest, const RbfOptions& options = {});

  void compile(const Handles& handles) override;
  Report update(const Eigen::Matrix3Xd& targets) override;
  const Shape& deformed() const override { return deformed_; }
  void reset() override { deformed_ = rest_; }

  const Eigen::Matrix3Xd& centers() const { return centers_; }  ///< 3×n c_j [length]

 private:
  void choose_centers();
  void choose_polynomials();
  void factorize();
  Eigen::MatrixXd basis(const Eigen::Ref<const Eigen::Matrix3Xd>& x) const;
  Eigen::MatrixXd fit(const Eigen::Matrix3Xd& displacements) const;
  Eigen::Matrix3Xd displacement() const;
  Eigen::Matrix3d gradient(const Eigen::Vector3d& x) const;
  bool deform();

  RbfOptions options_;
  Shape rest_, deformed_;
  std::vector<int> fixed_;
  Eigen::Matrix3Xd handles_;  // fixed, moved, points [length]
  double extent_ = 1;         // of the handles [length]; r and p are measured in it
  Eigen::Matrix3Xd centers_;
  Eigen::Vector3d origin_;                               // of p
  Eigen::MatrixXd axes_;                                 // 3×k, along which p is linear
  Eigen::HouseholderQR<Eigen::MatrixXd> sides_, solve_;  // of the side conditions, of the fit
  Eigen::MatrixXd basis_;                                // (n+1+k)×#V, or empty
  Eigen::MatrixXd w_;                                    // 3×(n+1+k): w_j, then p's [length]
  std::map<std::string, double> seconds_;
  std::vector<std::string> notes_;
};

}  // namespace deformlab
