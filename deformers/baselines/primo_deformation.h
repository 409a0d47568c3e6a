#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "deformers/baselines/prism_equations.h"
#include "deformers/deformer.h"
#include "geometry/core/options.h"

namespace deformlab {

/// The options of PriMo.
struct PrimoOptions {
  /// The height of the prisms [diagonal of the shape's bounding box]. What bending costs beside
  /// stretching grows with its square, and is the same at any resolution of the mesh.
  double height = 0.04;
  double handle_weight = 1000;  ///< of a handle, where the weight of a joint is about 1
  double epsilon = 1e-6;        ///< of the three conditions of Sumner et al. 2007, Eq. 12
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
/// rigid prism stands on each triangle, neighbours are coupled by elastic joints, and a vertex is
/// where the prisms around it have it on average. Needs triangles; they may form any surface.
///
/// The joints' energy is minimised by the paper's global shape matching: Gauss–Newton steps over
/// velocities, each projected to rigid motions, halved until the energy falls. The paper's
/// hierarchical multigrid solver and its local shape matching, which make large meshes interactive
/// there, are not here: every step factorizes the whole system.
///
/// Handles prescribe the motion of prisms. Here they are vertices: a prism of three of them moves
/// as their targets, fitted rigidly, and its vertices follow it alone. A handle without such a
/// prism (a single vertex, a line of them) leaves the prisms around it free and pulls each at its
/// corner.
class PrimoDeformation final : public Deformer {
 public:
  /// Throws InputError for a shape without triangles and for options out of range.
  explicit PrimoDeformation(Shape rest, const PrimoOptions& options = {});

  /// Throws InputError as Deformer says, and for handles that are no vertices.
  void compile(const Handles& handles) override;
  /// Report: a node is a prism, an edge is a joint.
  Report update(const Eigen::Matrix3Xd& targets) override;
  const Shape& deformed() const override { return deformed_; }
  void reset() override;

  const PrismLayer& prisms() const { return prisms_; }      ///< in length_unit()s
  const RigidMotions& motions() const { return motions_; }  ///< in length_unit()s
  double length_unit() const { return unit_; }              ///< mean side of a triangle [length]

 private:
  struct PointPin {
    std::vector<int> prisms;
    int pin;  // any: they are at one place
  };

  void choose_prescribed();
  std::vector<Pin> make_pins() const;
  std::vector<char> hold_free_parts(const std::vector<Pin>& pins);
  void set_targets(const Eigen::Matrix3Xd& targets);
  void carry_along();
  void deform(const Eigen::Matrix3Xd& targets);

  PrimoOptions options_;
  Shape rest_, deformed_;
  double unit_ = 1;
  Eigen::Matrix3Xd V_;  // rest_.V in units
  PrismLayer prisms_;
  RigidMotions motions_;
  Handles handles_;
  std::vector<int> handle_of_;  // of each vertex the column of the targets, or −1
  std::vector<char> prescribed_, on_prescribed_;  // of each prism, of each vertex
  std::vector<PointPin> at_one_point_;
  std::unique_ptr<PrismEquations> equations_;
  std::map<std::string, double> seconds_;
  std::vector<std::string> registration_notes_, compilation_notes_;
};

}  // namespace deformlab
