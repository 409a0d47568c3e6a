#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "energies/catalog.h"
#include "geometry/graph/deformation_graph.h"
#include "solvers/loss.h"
#include "solvers/options.h"
#include "solvers/problem.h"

namespace deformlab {

/// A term that a program adds to the energy without registering it.
struct ExtraTerm {
  /// Makes the term's sum. It is called for every set of handles.
  std::function<std::unique_ptr<Energy>(const GraphContext&)> make;
  double weight = 1;
  LossOptions loss{};
};

/// The options of embedded deformation.
struct EmbeddedDeformationOptions {
  GraphOptions graph;
  /// Weight w and options of each term; a term that is not named has its defaults.
  std::map<std::string, TermSettings> energies;
  /// ρ of a term, by its name; a term that is not named has none. A loss is meant for handles that
  /// cannot all reach their targets, such as wrong targets among right ones. The paper has none.
  std::map<std::string, LossOptions> losses;
  /// Terms beside those of the catalog. Configs do not know them.
  std::vector<ExtraTerm> extra_terms;
  /// E_rot has no unit, while E_reg and E_con are lengths²: their balance depends on what a length
  /// is measured in. With "mean_edge", the mean edge of the graph, the result does not depend on
  /// the unit of the shape. A number is that many of the shape's own units (1: the formula as
  /// printed).
  std::string length_unit = "mean_edge";
  /// 2: the shape lies in the plane, z stays as it is, and a node has six unknowns instead of
  /// twelve in the same terms (Sumner et al. 2007, section 7, mentions images).
  int dimension = 3;
  /// E_rot cannot tell a reflection from a rotation, and a large edit in one step can turn nodes
  /// inside out (det R < 0). report: the report counts these nodes. repair: they are turned back,
  /// and the solver goes on from there (deformers/embedded/reflections.h). Where F has its least
  /// value at a fold, the term `orientation` stays in the problem to keep the fold open.
  std::string reflections = "report";
  /// affine: a node has twelve unknowns, and E_rot draws R_j towards a rotation, as in the paper.
  /// rigid: it has six, a rotation vector and t_j; R_j is a rotation by construction, so that E_rot
  /// is zero. No term is Kronecker then.
  std::string rotation_model = "affine";
  SolverOptions solver;

  NodeModel node_model() const {
    return rotation_model == "rigid" ? NodeModel::kRigid : NodeModel::kAffine;
  }

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("graph", o.graph, "the deformation graph");
    visit("energies", o.energies,
          "weight of each energy term, or a map of its weight and its options; a term that is not "
          "named has its default weight");
    visit("losses", o.losses,
          "loss of an energy term, which limits the pull of residuals that cannot become small");
    visit("length_unit", o.length_unit, "mean_edge, or a number in the shape's own unit");
    visit("dimension", o.dimension, "3, or 2 for a shape in the plane, such as a drawing");
    visit.choice("reflections", o.reflections, {"report", "repair"},
                 "nodes that turn space inside out are counted in the report, or turned back "
                 "before the solver goes on");
    visit.choice("rotation_model", o.rotation_model, {"affine", "rigid"},
                 "a node's unknowns: R_j and t_j, or a rotation vector and t_j (no E_rot)");
    visit("solver", o.solver, "how the energy is minimised");
  }
};

/// Throws InputError for an option that is unknown or out of range, or that does not go with the
/// others or with the shape.
void check(const EmbeddedDeformationOptions& options, const Shape& rest);

/// Throws InputError where the dimension is neither 2 nor 3, or is 2 and z differs over the shape.
void check_dimension(int d, const Shape& rest);

/// The unit of length of the problem, which is measured in the graph or given as a number [length].
/// Throws InputError for other text and for a number far from the mean edge of the graph.
double length_unit(const std::string& text, const DeformationGraph& graph);

/// All terms of the catalog that have a weight, then the extra terms, each summed over the context.
std::vector<WeightedEnergy> make_terms(const EmbeddedDeformationOptions& options,
                                       const GraphContext& context);

}  // namespace deformlab
