#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "deformers/baselines/spokes_and_rims.h"
#include "deformers/deformer.h"
#include "geometry/core/options.h"

namespace deformlab {

/// The energy that CGAL minimises: spokes_and_rims, its own default; original (Sorkine and Alexa
/// 2007), where negative weights count as 0; or smooth_rotations (Levi and Gotsman 2015).
enum class CgalArapVariant { kSpokesAndRims, kOriginal, kSmoothRotations };
constexpr auto names_of(CgalArapVariant) {
  using enum CgalArapVariant;
  return std::to_array<EnumName<CgalArapVariant>>({{kSpokesAndRims, "spokes_and_rims"},
                                                   {kOriginal, "original"},
                                                   {kSmoothRotations, "smooth_rotations"}});
}

/// The options of CGAL's as-rigid-as-possible deformation.
struct CgalArapOptions {
  CgalArapVariant variant = CgalArapVariant::kSpokesAndRims;
  int iterations = 100;
  double tolerance = 1e-4;  ///< relative change of the energy

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("variant", o.variant,
          "The energy: CGAL's default, that of Sorkine and Alexa 2007, or that of Levi and Gotsman "
          "2015");
    visit.range("iterations", o.iterations, {.min = 1},
                "The greatest number of iterations, each a local and a global step");
    visit.range("tolerance", o.tolerance,
                {.min = 0, .max = 1, .exclusive_min = true, .exclusive_max = true},
                "The iterations end when one changes the energy by a smaller share than this");
  }
};

/// As-rigid-as-possible surface deformation as CGAL has it (Surface_mesh_deformation). All vertices
/// are in the region of interest, and those held are its control vertices.
///
/// The cost in reports is the energy of spokes and rims for every variant: what CGAL minimises is
/// not accessible.
class CgalArap final : public Deformer {
 public:
  /// Throws InputError for a shape that is no manifold triangle mesh, naming where it is not (other
  /// polygons are cut into triangles) or has a triangle of no area, and for options out of range.
  explicit CgalArap(Shape rest, const CgalArapOptions& options = {});
  ~CgalArap() override;

  /// Throws InputError as Deformer says, and for handles that are no vertices.
  void compile(const Handles& handles) override;
  Report update(const Eigen::Matrix3Xd& targets) override;
  const Shape& deformed() const override { return deformed_; }
  void reset() override;

  class Engine;  ///< CGAL's class for one of the variants

 private:
  void register_shape();
  std::vector<int> hold_free_parts();
  void set_targets(const Eigen::Matrix3Xd& targets);
  std::pair<Status, std::string> iterate(Summary& summary, SpokesAndRims& state);
  void store(const Eigen::Matrix3Xd& targets, const Eigen::Matrix3Xd& R);

  CgalArapOptions options_;
  Shape rest_, deformed_;
  std::vector<int> vertices_, place_;  // those in triangles; of each vertex its place there, or −1
  Eigen::Matrix3Xi T_;                 // 3×m places
  Eigen::Matrix3Xd V_, W_;             // 3×n at rest and deformed, by place
  std::unique_ptr<Engine> engine_;
  Handles handles_;
  int unknowns_ = 0;
  bool solvable_ = true;
  std::map<std::string, double> seconds_;
  std::vector<std::string> registration_notes_, compilation_notes_;
};

}  // namespace deformlab
