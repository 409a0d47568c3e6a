#pragma once

#include <memory>
#include <span>
#include <vector>

#include "deformers/embedded/embedded_deformation.h"

namespace deformlab {

/// Embedded deformation whose graph grows where an edit needs it: "the individual terms of the
/// objective function tell us when and where errors occur" (Sumner et al. 2007, section 6). It
/// begins with graph.adaptive.start nodes. After a solve nodes are added where the terms cost most
/// (worst_vertices); they begin as the old graph deforms their places, the others stay as they are,
/// and the solver goes on from there, until after graph.adaptive.rounds refinements there are
/// graph.nodes. An update that leaves the shape at rest adds none, and once there, nodes stay.
///
/// Each refinement costs a registration and a compilation, so this saves nodes before it saves
/// time; and the more of a shape an edit deforms, the fewer. graph.alpha: length belongs to it:
/// with equal weights a dense part bends more easily.
class AdaptiveDeformation final : public Deformer {
 public:
  /// Throws InputError as EmbeddedDeformation does, and for a graph made by hand, a start of less
  /// than 1 or not below graph.nodes, or another number of rounds than 1 … graph.nodes − start.
  AdaptiveDeformation(Shape rest, const EmbeddedDeformationOptions& options,
                      std::span<const Cut> cuts = {});

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
  EmbeddedDeformationOptions options_;
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
