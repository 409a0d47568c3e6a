#pragma once

#include <Eigen/Core>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "geometry/graph/deformation_graph.h"
#include "geometry/graph/graph_cut.h"
#include "geometry/transfer/graph_embedding.h"

namespace deformlab {

/// A deformation graph with a shape embedded in it.
struct BuiltGraph {
  DeformationGraph graph;
  Embedding embedding;  ///< of all vertices
  /// The vertex that each node sits on; else, with cuts or distances along a surface, the nearest
  /// to it; otherwise empty.
  std::vector<int> node_vertices;
  bool in_space = true;            ///< straight distances and no cut: any place can be embedded
  std::vector<std::string> notes;  ///< what a user should know, a sentence each
  std::map<std::string, double> seconds;  ///< that it took to sample, embed and connect
};

/// Places the nodes as options.method says, embeds the shape and joins the nodes: with one another
/// where they influence the same vertex, or as a hand-made graph has it. Of nodes that are apart by
/// a cut neither is joined, and a hand-made edge without a weight is left out. With a distance
/// along the surface sampled nodes are moved to the nearest vertices, each to one of its own, and
/// sit there. Throws InputError for a shape that `check` refuses, and for options that are out of
/// range or do not fit the shape or each other.
BuiltGraph build_graph(const Shape& shape, const GraphOptions& options,
                       std::span<const Cut> cuts = {});

/// The same with nodes that are already placed (3×m) [length]. Throws also for nodes that `check`
/// refuses as points.
BuiltGraph build_graph(const Shape& shape, const Eigen::Matrix3Xd& nodes,
                       const GraphOptions& options, std::span<const Cut> cuts = {});

/// The same with a graph that is already made, whose edges stay.
BuiltGraph build_graph(const Shape& shape, DeformationGraph graph, const GraphOptions& options,
                       std::span<const Cut> cuts = {});

}  // namespace deformlab
