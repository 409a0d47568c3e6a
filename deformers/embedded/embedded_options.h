#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "energies/catalog.h"
#include "geometry/core/options.h"
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

/// What is done about nodes that an edit turns inside out, det R < 0, which E_rot cannot tell from
/// rotations. report counts them in the report. repair turns them back, and the solver goes on from
/// there (deformers/embedded/reflections.h); where F has its least value at a fold, the term
/// `orientation` stays in the problem to keep the fold open.
enum class Reflections { kReport, kRepair };
constexpr auto names_of(Reflections) {
  using enum Reflections;
  return std::to_array<EnumName<Reflections>>({{kReport, "report"}, {kRepair, "repair"}});
}

/// The unknowns of a node. affine: the twelve numbers of R_j and t_j, where E_rot draws R_j towards
/// a rotation, as in the paper. rigid: a rotation vector and t_j, six numbers; R_j is a rotation by
/// construction, so that E_rot is zero, and no term is Kronecker.
enum class RotationModel { kAffine, kRigid };
constexpr auto names_of(RotationModel) {
  using enum RotationModel;
  return std::to_array<EnumName<RotationModel>>({{kAffine, "affine"}, {kRigid, "rigid"}});
}

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
  Reflections reflections = Reflections::kReport;
  RotationModel rotation_model = RotationModel::kAffine;
  SolverOptions solver;
  int transfer_threads = 1;  ///< the result does not depend on their number

  NodeModel node_model() const {
    return rotation_model == RotationModel::kRigid ? NodeModel::kRigid : NodeModel::kAffine;
  }

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("graph", o.graph, "The deformation graph");
    visit.range(
        "energies", o.energies, {.min = 0},
        "The weight of each energy term, or a map of its weight and its options. A term that "
        "is not named keeps its defaults");
    visit("losses", o.losses,
          "Robust losses of energy terms, with which residuals that cannot become small pull less");
    visit("length_unit", o.length_unit,
          "The length that counts as 1 in the energy: mean_edge, or a number in the shape's own "
          "unit");
    visit.range("dimension", o.dimension, {.min = 2, .max = 3},
                "3 for shapes in space, 2 for a shape in the plane, such as a drawing");
    visit("reflections", o.reflections,
          "What is done about nodes that an edit turns inside out: report them, or turn them back "
          "and go on solving");
    visit("rotation_model", o.rotation_model,
          "The unknowns of a node: a matrix R_j and t_j, or a rotation vector and t_j, for which "
          "E_rot vanishes");
    visit("solver", o.solver, "The solver that minimises the energy");
    visit.range("transfer_threads", o.transfer_threads, {.min = 1, .max = 1024},
                "The number of threads that move the vertices after a solve. It does not change "
                "the result");
  }
};

/// Throws OptionError for an option that is not allowed, or that does not go with the others or
/// with the shape.
void check(const EmbeddedDeformationOptions& options, const Shape& rest);

/// Throws OptionError where the dimension is 2 and z differs over the shape.
void check_dimension(int d, const Shape& rest);

/// The unit of length of the problem, which is measured in the graph or given as a number [length].
/// Throws OptionError for other text and for a number far from the mean edge of the graph.
double length_unit(const std::string& text, const DeformationGraph& graph);

/// All terms of the catalog that have a weight, then the extra terms, each summed over the context.
std::vector<WeightedEnergy> make_terms(const EmbeddedDeformationOptions& options,
                                       const GraphContext& context);

}  // namespace deformlab
