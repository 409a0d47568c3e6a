#pragma once

#include <memory>
#include <vector>

#include "deformers/baselines/baseline.h"
#include "deformers/baselines/prism_equations.h"
#include "geometry/core/options.h"

namespace deformlab {

/// The options of PriMo.
struct PrimoOptions {
  /// The height of the prisms [diagonal of the shape's bounding box]. The ratio of the costs of
  /// bending and stretching grows with its square and is the same at any resolution of the mesh.
  double height = 0.04;
  double handle_weight = 1000;  ///< the weight of a joint is about 1
  double epsilon = 1e-6;        ///< tolerance of the conditions of Sumner et al. 2007, Eq. 12
  int max_iterations = 100;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("height", o.height, {.min = 1e-5, .max = 10},
                "The height of the prisms, as a share of the diagonal of the shape's bounding box; "
                "higher prisms bend less");
    visit.range("handle_weight", o.handle_weight, {.min = 1e-6, .max = 1e9},
                "The weight of a handle that has no whole triangle, where that of a joint is about "
                "1");
    visit.range(
        "epsilon", o.epsilon, {.min = 1e-30, .max = 0.5},
        "The tolerance of the three conditions of convergence (Sumner et al. 2007, Eq. 12)");
    visit.range("max_iterations", o.max_iterations, {.min = 1, .max = 1e6},
                "The solver stops after this number of steps even if it has not converged");
  }
};

/// PriMo: Coupled Prisms for Intuitive Surface Modeling (Botsch, Pauly, Gross and Kobbelt 2006). A
/// rigid prism stands on each triangle, and elastic joints couple neighbouring prisms. The position
/// of a vertex is the mean over the prisms around it. The method needs triangles, which may form
/// any surface.
///
/// The energy of the joints is minimised by the paper's global shape matching with second
/// derivatives: Newton steps over velocities, each of which is projected to rigid motions and
/// halved until the energy falls.
/// The paper makes large meshes interactive by a hierarchical multigrid solver and by local shape
/// matching. These are not implemented: every step factorizes the whole system.
///
/// Handles prescribe the motion of prisms. A prism whose three vertices are handles moves rigidly
/// as it fits their targets best, and its vertices follow this prism alone. A handle without such a
/// prism (a single vertex, or a line of vertices) leaves the prisms around it free and pulls each
/// of them at its corner.
///
/// In a report, a node is a prism and an edge is a joint.
class PrimoDeformation final : public Baseline {
 public:
  /// Registration. Throws InputError for a shape without triangles and for options out of range.
  explicit PrimoDeformation(Shape rest, const PrimoOptions& options = {});

  void reset() override;

  const PrismLayer& prisms() const { return prisms_; }      ///< lengths in length_unit()
  const RigidMotions& motions() const { return motions_; }  ///< lengths in length_unit()
  double length_unit() const { return unit_; }              ///< mean side of a triangle [length]

 private:
  /// Throws InputError for handles that are no vertices.
  void check_supported(const Handles& handles) const override;
  void compile_handles() override;
  void solve(const Eigen::Matrix3Xd& targets, Report& report) override;

  // A connected component whose pins are all at one point.
  struct PointPin {
    std::vector<int> prisms;
    int pin;  // one of the pins
  };

  void choose_prescribed();
  std::vector<Pin> make_pins() const;
  std::vector<char> fix_free_components(const std::vector<Pin>& pins);
  void set_targets(const Eigen::Matrix3Xd& targets);
  void translate_components();
  void deform(const Eigen::Matrix3Xd& targets);

  PrimoOptions options_;
  double unit_ = 1;
  Eigen::Matrix3Xd V_;  // rest_.V [unit_]
  PrismLayer prisms_;
  RigidMotions motions_;
  std::vector<int> handle_of_;    // #V: the column of the vertex in the handles' targets, or −1
  std::vector<char> prescribed_;  // #prisms: whether handles prescribe its motion
  std::vector<char> on_prescribed_;  // #V: whether the vertex belongs to such a prism
  std::vector<PointPin> at_one_point_;
  std::unique_ptr<PrismEquations> equations_;
};

}  // namespace deformlab
