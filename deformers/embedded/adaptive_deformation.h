#pragma once

#include <memory>
#include <span>
#include <vector>

#include "deformers/embedded/embedded_deformation.h"

namespace deformlab {

/// Embedded deformation whose graph gets nodes where an edit needs them: "the individual terms of
/// the objective function tell us when and where errors occur" (Sumner et al. 2007, section 6). The
/// graph begins with graph.adaptive.start nodes. After a solve, nodes are added where the terms
/// cost most (worst_vertices). A new node begins with the deformation that the old graph has at its
/// position, the others keep theirs, and the solver goes on from there. After graph.adaptive.rounds
/// refinements there are graph.nodes. An update that leaves the shape at rest adds no nodes, and
/// nodes that were added stay.
///
/// Each refinement costs a registration and a compilation. So adaptive graphs save nodes rather
/// than time, and they save fewer nodes the more of a shape an edit deforms. Use graph.alpha:
/// length with them: with equal weights a dense part of a graph bends more easily.
class AdaptiveDeformation final : public Deformer {
 public:
  /// Throws InputError as EmbeddedDeformation does, and for a graph made by hand, for a start that
  /// is not in 1 … graph.nodes − 1, and for rounds that are not in 1 … graph.nodes − start.
  AdaptiveDeformation(Shape rest, const EmbeddedDeformationOptions& options,
                      std::span<const Cut> cuts = {});

  void compile(const Handles& handles) override;
  /// Refines until there are graph.nodes. The report is that of the last solve, with the steps and
  /// the seconds of all solves.
  Report update(const Eigen::Matrix3Xd& targets) override;
  const Shape& deformed() const override { return embedded_->deformed(); }
  void reset() override { embedded_->reset(); }

  const EmbeddedDeformation& embedded() const { return *embedded_; }

 private:
  int next_count(int m) const;
  bool refine();

  Shape rest_;
  EmbeddedDeformationOptions options_;
  std::vector<Cut> cuts_;
  Handles handles_;
  std::unique_ptr<EmbeddedDeformation> embedded_;
};

/// The share of F that each node has: the cost of an element is divided equally among the nodes
/// that it reads.
Eigen::VectorXd node_costs(const Problem& problem);

/// Vertices at which nodes should be added, chosen one after another. Each is the vertex with the
/// largest product of two numbers: the cost of the nodes that it follows, and its distance to the
/// nearest node or chosen vertex. All nodes with a weight above 0 count alike, because a node may
/// be fixed on account of that vertex until the vertex has nearer ones. Fewer than `count` are
/// returned if no product is above zero.
///   g  3×m nodes [length], costs  m.
std::vector<int> worst_vertices(const Embedding& vertices, const Eigen::Matrix3Xd& g,
                                const Eigen::VectorXd& costs, int count);

/// The transformations of a deformation's nodes, followed by those of new nodes at some of its
/// vertices. A new R_j is blended with the weights of Eq. 2, and t_j takes the node to where its
/// vertex is.
Transformations continued(const EmbeddedDeformation& deformation, std::span<const int> vertices);

/// The embedded deformation that `deformer` is or contains, or null if it is another method.
const EmbeddedDeformation* as_embedded(const Deformer& deformer);

}  // namespace deformlab
