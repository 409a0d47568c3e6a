#pragma once

#include <memory>
#include <span>
#include <vector>

#include "deformers/embedded/embedded_deformation.h"

namespace deformlab {

/// How a graph grows where an edit needs it.
struct AdaptiveOptions {
  int start = 0;   ///< nodes at the beginning; 0: the graph does not grow
  int rounds = 4;  ///< number of refinements

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("start", o.start, {.min = 0},
                "The number of nodes that the graph begins with, less than graph.nodes; 0 begins "
                "with all of them");
    visit.range("rounds", o.rounds, {.min = 1},
                "The number of refinements in which the graph grows to graph.nodes, each time "
                "where the energy terms cost most");
  }
};

/// Embedded deformation whose graph grows where an edit needs it: "the individual terms of the
/// objective function tell us when and where errors occur" (Sumner et al. 2007, section 6). It
/// begins with adaptive.start nodes. After a solve, nodes are added where the terms cost most
/// (worst_vertices). A new node begins with the transformation that the old graph gives its
/// position, the others keep theirs, and the solver goes on from there, until after adaptive.rounds
/// refinements there are graph.nodes. An update that leaves the shape at rest adds no node, and
/// nodes that have been added stay.
///
/// Each refinement costs a registration and a compilation, so that this saves nodes before it saves
/// time; and the larger the part of a shape that an edit deforms, the less it saves. Use it with
/// graph.alpha: length, because with equal weights a dense part of a graph bends more easily.
class AdaptiveDeformation final : public Deformer {
 public:
  /// Throws InputError as EmbeddedDeformation does, and for a graph that a file gives, a start
  /// outside of 1 … graph.nodes − 1, or rounds outside of 1 … graph.nodes − start. Errors of
  /// AdaptiveOptions name the option "adaptive.start" or "adaptive.rounds".
  AdaptiveDeformation(Shape rest, const EmbeddedDeformationOptions& options,
                      const AdaptiveOptions& adaptive, std::span<const Cut> cuts = {});

  void compile(const Handles& handles) override;
  /// Refines until there are graph.nodes. The report is of the last solve; its steps and seconds
  /// are those of all.
  Report update(const Eigen::Matrix3Xd& targets) override;
  const Shape& deformed() const override { return embedded_->deformed(); }
  void reset() override { embedded_->reset(); }

  const EmbeddedDeformation& embedded() const { return *embedded_; }

 private:
  int next_count(int m) const;
  bool refine();

  Shape rest_;
  EmbeddedDeformationOptions options_;  // of the graph at the end
  AdaptiveOptions adaptive_;
  std::vector<Cut> cuts_;
  Handles handles_;
  std::unique_ptr<EmbeddedDeformation> embedded_;
};

/// Of every node its share of F: each element counts to equal parts for the nodes that it reads.
Eigen::VectorXd node_costs(const Problem& problem);

/// Vertices to add nodes at, one after another: where what the nodes that the vertex follows cost,
/// times the distance to the nearest node there is by then, is largest. However little it follows
/// them: a node may be fixed because of that vertex, until it has nearer ones. Fewer than `count`
/// where nothing is above zero.
///   g  3×m nodes [length], costs  m.
std::vector<int> worst_vertices(const Embedding& vertices, const Eigen::Matrix3Xd& g,
                                const Eigen::VectorXd& costs, int count);

/// The transformations of a deformation's nodes, and of more nodes at some of its vertices: their
/// R_j blended as Eq. 2 blends, and the t_j that takes each where its vertex is.
Transformations continued(const EmbeddedDeformation& deformation, std::span<const int> vertices);

/// Embedded deformation as `deformer` runs it, or null where that is another method.
const EmbeddedDeformation* as_embedded(const Deformer& deformer);

}  // namespace deformlab
