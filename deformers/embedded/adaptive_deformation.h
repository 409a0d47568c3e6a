#pragma once

#include <memory>
#include <span>
#include <vector>

#include "deformers/embedded/embedded_deformation.h"

namespace deformlab {

/// The options of a graph that grows where an edit needs it.
struct AdaptiveOptions {
  int start = 0;  ///< with 0 the graph does not grow
  int rounds = 4;

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
/// position, the others keep theirs, and the solver continues from there. After adaptive.rounds
/// refinements there are graph.nodes. An update that leaves the shape at rest adds no node, and
/// nodes that have been added stay.
///
/// Each refinement costs a registration and a compilation, so that this saves nodes rather than
/// time. It saves less, the larger the part of a shape is that an edit deforms. Use it with
/// graph.alpha: length, because with equal weights a dense part of a graph bends more easily.
class AdaptiveDeformation final : public Deformer {
 public:
  /// Throws InputError as EmbeddedDeformation does, and for a graph that a file gives, a start
  /// outside of 1 … graph.nodes − 1, or rounds outside of 1 … graph.nodes − start. Errors of
  /// AdaptiveOptions name the option "adaptive.start" or "adaptive.rounds".
  AdaptiveDeformation(Shape rest, const EmbeddedDeformationOptions& options,
                      const AdaptiveOptions& adaptive, std::span<const Cut> cuts = {});

  void compile(const Handles& handles) override;
  /// Refines until there are graph.nodes. The report is that of the last solve, but its steps and
  /// seconds are those of all solves.
  Report update(const Eigen::Matrix3Xd& targets) override;
  const Shape& deformed() const override { return embedded_->deformed(); }
  void reset() override { embedded_->reset(); }

  const EmbeddedDeformation& embedded() const { return *embedded_; }

 private:
  int next_count(int m) const;
  bool refine();

  Shape rest_;
  EmbeddedDeformationOptions options_;  // with the final number of nodes
  AdaptiveOptions adaptive_;
  std::vector<Cut> cuts_;
  Handles handles_;
  std::unique_ptr<EmbeddedDeformation> embedded_;
};

/// The share of each node in F (m). Each summand of a term is divided equally among its nodes.
Eigen::VectorXd node_costs(const Problem& problem);

/// The vertices at which nodes should be added. Each has the greatest product of two factors: the
/// sum of the costs (m) of the nodes that it follows, and its distance to the nearest of the nodes
/// g (3×m) [length] and of the vertices chosen before. Weights do not matter in the sum, because
/// even a vertex that hardly follows a node may fix it. Returns fewer than `count` vertices where
/// no other product is above 0.
std::vector<int> worst_vertices(const Embedding& vertices, const Eigen::Matrix3Xd& g,
                                const Eigen::VectorXd& costs, int count);

/// The transformations of a deformation's nodes, followed by those of new nodes at some vertices. A
/// new R_j is blended by the weights of Eq. 2, and t_j moves the node to its deformed vertex.
Transformations continued(const EmbeddedDeformation& deformation, std::span<const int> vertices);

/// The embedded deformation that `deformer` is or contains, or null for another method.
const EmbeddedDeformation* as_embedded(const Deformer& deformer);

}  // namespace deformlab
