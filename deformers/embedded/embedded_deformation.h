#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>

#include "deformers/deformer.h"
#include "deformers/embedded/pins.h"
#include "geometry/graph/deformation_graph.h"
#include "geometry/graph/graph_build.h"
#include "geometry/transfer/transfer.h"
#include "solvers/loss.h"
#include "solvers/solver.h"

namespace deformlab {

/// What embedded deformation can be told.
struct EmbeddedDeformationOptions {
  GraphOptions graph;
  std::map<std::string, double> energies;  ///< weight w of each term; one not named has its default
  /// ρ of a term, by its name; one not named has none. Handles that cannot all be met (wrong
  /// targets among right ones) are what it is for; the paper has no such thing.
  std::map<std::string, LossOptions> losses;
  /// E_rot has no unit, E_reg and E_con are lengths²: their balance depends on what a length is
  /// measured in. "mean_edge", the mean edge of the graph, makes the result independent of the
  /// shape's unit; a number is that many of the shape's own (1: the formula as printed).
  std::string length_unit = "mean_edge";
  /// 2: the shape lies in the plane, of z nothing is asked, and a node has six unknowns instead of
  /// twelve, the same terms being summed (Sumner et al. 2007, section 7, names images).
  int dimension = 3;
  /// E_rot cannot tell a reflection from a rotation, and an edit in one shot can turn nodes inside
  /// out (det R < 0). report: that is counted and said. repair: they are turned back and solved on
  /// (deformers/embedded/reflections.h); where F is least at a fold, the term `orientation` stays
  /// to hold it open.
  std::string reflections = "report";
  /// affine: twelve unknowns a node, and E_rot draws R_j towards a rotation (the paper's). rigid: a
  /// rotation vector and t_j, six; R_j is a rotation by construction, and E_rot is nothing. No term
  /// is Kronecker then.
  std::string rotation_model = "affine";
  SolverOptions solver;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("graph", o.graph, "the deformation graph");
    visit("energies", o.energies, "weight of each energy term; one not named has its default");
    visit("losses", o.losses, "of energy terms: less pull of residuals that cannot become small");
    visit("length_unit", o.length_unit, "mean_edge, or a number in the shape's own unit");
    visit("dimension", o.dimension, "3, or 2 for a shape in the plane, such as a drawing");
    visit.choice("reflections", o.reflections, {"report", "repair"},
                 "nodes where space is turned inside out: say so, or turn them back and solve on");
    visit.choice("rotation_model", o.rotation_model, {"affine", "rigid"},
                 "a node's unknowns: R_j and t_j, or a rotation vector and t_j (no E_rot)");
    visit("solver", o.solver, "how the energy is minimised");
  }
};

/// Embedded Deformation for Shape Manipulation (Sumner, Schmid, Pauly 2007).
class EmbeddedDeformation final : public Deformer {
 public:
  /// Builds the graph; `cuts` are parts that must not pull at each other. Throws InputError for
  /// options and cuts out of range, or that do not fit the shape.
  EmbeddedDeformation(Shape rest, const EmbeddedDeformationOptions& options,
                      std::span<const Cut> cuts = {});
  /// Takes a graph whose nodes are already placed (3×m) [length].
  EmbeddedDeformation(Shape rest, const Eigen::Matrix3Xd& nodes,
                      const EmbeddedDeformationOptions& options, std::span<const Cut> cuts = {});
  /// Takes a graph that is already made, edges and all [length].
  EmbeddedDeformation(Shape rest, DeformationGraph graph,
                      const EmbeddedDeformationOptions& options);

  void compile(const Handles& handles) override;
  Report update(const Eigen::Matrix3Xd& targets) override;
  const Shape& deformed() const override { return deformed_; }
  void reset() override;
  /// The rest shape takes another pose: the same vertices in other places, and the nodes (3×m) with
  /// them [length]. The graph's edges, all weights and the unit stay, the transformations begin at
  /// rest, and the handles have to be compiled again. Throws InputError for another number of
  /// vertices or nodes.
  void repose(const Shape& rest, const Eigen::Matrix3Xd& nodes);

  /// Takes on these transformations (3×4m), t_j [length], from which the next update starts; fixed
  /// nodes stay at rest, and rigid ones take the nearest rotations. Throws InputError for another
  /// number.
  void begin_at(const Transformations& X);

  const DeformationGraph& graph() const { return graph_; }   ///< at rest [length]
  const Embedding& embedding() const { return embedding_; }  ///< of all vertices [length]
  /// The vertex that each node sits on, or as BuiltGraph says.
  const std::vector<int>& node_vertices() const { return node_vertices_; }
  Transformations transformations() const;  ///< 3×4m, t_j [length]
  /// Where the transformations X (3×4m) take the handles that need be no vertices, 3×p [length].
  Eigen::Matrix3Xd points(const Transformations& X) const;
  const Problem& problem() const { return problem_; }  ///< d×(d+1)m or 3×2m, in length_unit()s
  double length_unit() const { return unit_; }

 private:
  void register_graph(BuiltGraph built);
  bool is_rigid() const { return options_.rotation_model == "rigid"; }
  Eigen::MatrixXd rest_unknowns(int m) const;
  void fix_nodes(const Handles& handles);
  void transfer(const Transformations& X);
  void carry_along(const Eigen::Matrix3Xd& targets);
  void measure_determinants(const Transformations& X, Report& report) const;

  EmbeddedDeformationOptions options_;
  Shape rest_, deformed_;
  Embedding embedding_, handles_;  // of the whole shape, and of what is moved [length]
  std::vector<int> fixed_;         // vertices
  Eigen::Index points_ = 0;        // the last columns of handles_ are no vertices
  DeformationGraph graph_;
  std::vector<int> node_vertices_;
  bool in_space_ = true;  // any place can be embedded by itself
  double unit_ = 1;
  Problem problem_;
  std::vector<PointPin> at_one_point_;
  std::unique_ptr<Solver> solver_;
  std::map<std::string, double> seconds_;
  std::vector<std::string> registration_notes_, compilation_notes_;
};

}  // namespace deformlab
