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
  /// Makes the term's sum. It is called for every graph, and again for other handles if it read
  /// the handles of its context.
  std::function<std::unique_ptr<Energy>(const GraphContext&)> make;
  double weight = 1;
  LossOptions loss{};
};

/// What is done about nodes that an edit turns inside out (det R < 0), which E_rot does not
/// distinguish from rotations. kReport counts them in the report. kRepair turns them back and
/// continues the solve from there (deformers/embedded/reflections.h).
enum class Reflections { kReport, kRepair };
constexpr auto names_of(Reflections) {
  using enum Reflections;
  return std::to_array<EnumName<Reflections>>({{kReport, "report"}, {kRepair, "repair"}});
}

/// The unknowns of a node. kAffine: the twelve numbers of R_j and t_j, where E_rot pulls R_j
/// towards a rotation, as in the paper. kRigid: a rotation vector and t_j, six numbers. R_j is then
/// always a rotation, so that E_rot is zero, and no term has Kronecker structure.
enum class RotationModel { kAffine, kRigid };
constexpr auto names_of(RotationModel) {
  using enum RotationModel;
  return std::to_array<EnumName<RotationModel>>({{kAffine, "affine"}, {kRigid, "rigid"}});
}

/// What happens to the nodes at the border of the fixed part. kEliminate: every node that
/// influences a fixed vertex stays at rest, as in the paper (Eq. 9). kSoft: only nodes that
/// influence no free vertex stay at rest. At the others, the fixed vertices are handles that stay
/// where they are, so that free vertices beside the fixed part can move. After a solve they are
/// exactly at rest too.
enum class Border { kEliminate, kSoft };
constexpr auto names_of(Border) {
  using enum Border;
  return std::to_array<EnumName<Border>>({{kEliminate, "eliminate"}, {kSoft, "soft"}});
}

/// Where a solve begins that follows no other: at rest, or at rotations and translations that the
/// handles' motions give to all nodes (deformers/embedded/harmonic_start.h).
enum class Start { kRest, kHarmonic };
constexpr auto names_of(Start) {
  using enum Start;
  return std::to_array<EnumName<Start>>({{kRest, "rest"}, {kHarmonic, "harmonic"}});
}

/// The options of embedded deformation. These defaults are those of Sumner et al. 2007;
/// preset_options (deformers/embedded/presets.h) gives those that suit most shapes and edits.
struct EmbeddedDeformationOptions {
  GraphOptions graph;
  /// The weight and options of each term by its name. A term that is not named has its defaults.
  std::map<std::string, TermSettings> energies;
  /// The robust loss ρ of each term by its name. A term that is not named has none, as in the
  /// paper. A loss is for handles that cannot all reach their targets, such as a few wrong targets.
  std::map<std::string, LossOptions> losses;
  /// Terms beside those of the catalog. Configs do not know them.
  std::vector<ExtraTerm> extra_terms;
  /// #V: how stiff the shape is around each vertex, above 0, as a factor of E_rot and E_reg. A node
  /// is as stiff as the stiffest vertex that it influences. Empty: 1 everywhere. Configs set it by
  /// `paint`.
  Eigen::VectorXd stiffness;
  /// E_rot has no unit, while E_reg and E_con are in [length²], so that their balance depends on
  /// the unit of length. With "mean_edge", the mean edge of the graph, the result does not depend
  /// on the unit of the shape. A number is a length in that unit; 1 gives the printed formula.
  std::string length_unit = "mean_edge";
  /// With 2 the shape lies in the plane, z stays as it is, and a node has six unknowns instead of
  /// twelve in the same terms (Sumner et al. 2007, section 7, mentions images).
  int dimension = 3;
  Reflections reflections = Reflections::kReport;
  RotationModel rotation_model = RotationModel::kAffine;
  Border border = Border::kEliminate;
  Start start = Start::kRest;
  /// The weight of E_con with which a solve is repeated, from the start, if nodes end inside out.
  /// Handles that are nearer to the fixed part than nodes are then give way. 0: it is not repeated.
  double relaxed_constraint = 0;
  /// Whether handles that are asked to turn, and whose targets do not tell how, hold the angle by
  /// places around them (deformers/embedded/handles/satellites.h). In the paper, a handle is a
  /// position.
  bool hold_angles = false;
  SolverOptions solver;
  int transfer_threads = 1;

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
    visit("border", o.border,
          "The nodes at the border of the fixed part: eliminate all that influence a fixed vertex "
          "(Eq. 9), or only those that influence no other, and hold the rest by handles");
    visit("start", o.start,
          "Where the first solve begins: at rest, or at rotations and translations that the "
          "handles' motions give to all nodes");
    visit("hold_angles", o.hold_angles,
          "Whether one vertex, or vertices on a line, hold the angle that 'rotate' gives them");
    visit.range("relaxed_constraint", o.relaxed_constraint, {.min = 0},
                "The weight of E_con with which a solve is repeated if nodes end inside out; 0: it "
                "is not repeated");
    visit("solver", o.solver, "The solver that minimises the energy");
    visit.range("transfer_threads", o.transfer_threads, {.min = 1, .max = 1024},
                "The number of threads that move the vertices after a solve. It does not change "
                "the result");
  }
};

/// Throws OptionError for an option that is not allowed, or that does not go with the others or
/// with the shape.
void check(const EmbeddedDeformationOptions& options, const Shape& rest);

/// Makes "auto" nodes inside a shape none. Throws OptionError ("graph.interior") if they are asked
/// for; `why` says why there cannot be any.
void refuse_interior(GraphOptions& options, const std::string& why);

/// Throws OptionError where the dimension is 2 and z differs over the shape.
void check_dimension(int d, const Shape& rest);

/// The unit of length of the problem, which is measured in the graph or given as a number [length].
/// Throws OptionError for other text and for a number far from the mean edge of the graph.
double length_unit(const std::string& text, const DeformationGraph& graph);

/// How a term of the problem is made.
struct TermRecipe {
  std::function<std::unique_ptr<Energy>(const GraphContext&)> make;
  double weight;
  std::shared_ptr<const ceres::LossFunction> loss;
};

/// The terms of the catalog with a weight above 0, followed by the extra terms.
std::vector<TermRecipe> term_recipes(const EmbeddedDeformationOptions& options);

}  // namespace deformlab
