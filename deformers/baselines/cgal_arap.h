#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "deformers/baselines/baseline.h"
#include "deformers/baselines/spokes_and_rims.h"
#include "geometry/core/options.h"

namespace deformlab {

/// The energy that CGAL minimises: spokes and rims, its default; the original (Sorkine and Alexa
/// 2007), where negative weights count as 0; or smooth rotations (Levi and Gotsman 2015).
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

/// As-rigid-as-possible surface deformation by CGAL (Surface_mesh_deformation). All vertices are in
/// CGAL's region of interest, and handles are its control vertices.
///
/// The cost in reports is the energy of spokes and rims for every variant, because CGAL gives no
/// access to the energy that it minimises.
class CgalArap final : public Baseline {
 public:
  /// Registration. Polygons of more than three corners are cut into triangles. Throws InputError
  /// for a shape whose triangles are no manifold mesh (the message names a position), for a
  /// triangle without area, and for options out of range.
  explicit CgalArap(Shape rest, const CgalArapOptions& options = {});
  ~CgalArap() override;

  void reset() override;

  class Engine;  ///< CGAL's class for one of the variants

 private:
  /// Throws InputError for handles that are no vertices.
  void check_supported(const Handles& handles) const override;
  void compile_handles() override;
  void solve(const Eigen::Matrix3Xd& targets, Report& report) override;

  void register_shape();
  std::vector<int> control_vertices();
  void set_targets(const Eigen::Matrix3Xd& targets);
  std::pair<Status, std::string> iterate(Summary& summary, SpokesAndRims& state);
  void store(const Eigen::Matrix3Xd& targets, const Eigen::Matrix3Xd& R);

  CgalArapOptions options_;
  std::vector<int> vertices_;  // the vertices in triangles, which are those of CGAL's mesh
  std::vector<int> index_;     // the inverse: the index of each vertex of the shape there, or −1
  Eigen::Matrix3Xi T_;         // 3×#T triangles of CGAL's mesh
  Eigen::Matrix3Xd V_, W_;     // 3×#V of CGAL's mesh, at rest and deformed [length]
  std::unique_ptr<Engine> engine_;
  int unknowns_ = 0;
  bool solvable_ = true;
};

}  // namespace deformlab
