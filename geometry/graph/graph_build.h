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
  /// The vertex that each node sits on. For nodes that sit on none: the vertex nearest to each node
  /// where cuts or distances along a surface need it, and otherwise nothing.
  std::vector<int> node_vertices;
  std::vector<int> active{};  ///< the vertices that are embedded, ascending; empty if all are
  bool in_space = true;  ///< distances are straight and there is no cut: any point can be embedded
  std::vector<std::string> notes;         ///< what a user should know, in one sentence each
  std::map<std::string, double> seconds;  ///< the times of "sample", "embed" and "connect" [s]
};

/// Places the nodes as options.method says, embeds the shape, and joins two nodes where they
/// influence the same vertex, or where options.file joins them. Nodes on different sides of a cut
/// are not joined, and an edge of a file that gets no weight is left out. With a distance along the
/// surface, each sampled node is moved to the nearest vertex that has no node yet. Throws
/// InputError for a shape that `check` refuses, and OptionError for options that are out of range
/// or do not fit the shape or each other.
///   fixed  vertices that stay where they are; with options.region "active", only what they leave
///          free is embedded, and a margin of them
BuiltGraph build_graph(const Shape& shape, const GraphOptions& options,
                       std::span<const Cut> cuts = {}, std::span<const int> fixed = {});

/// Does the same with nodes that are already placed (3×m) [length]. Throws also for nodes that
/// `check` refuses as points.
BuiltGraph build_graph(const Shape& shape, const Eigen::Matrix3Xd& nodes,
                       const GraphOptions& options, std::span<const Cut> cuts = {});

/// Does the same with a graph that is already made and keeps its edges. Throws also for a graph
/// that `check` refuses.
BuiltGraph build_graph(const Shape& shape, DeformationGraph graph, const GraphOptions& options,
                       std::span<const Cut> cuts = {});

}  // namespace deformlab
