#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "geometry/core/options.h"
#include "geometry/shape/shape.h"
#include "geometry/transfer/embedding.h"

namespace deformlab {

/// How many nodes a graph may have. The greatest number is far beyond what solves in seconds.
inline constexpr Range kNodeRange{.min = 1, .max = 100'000};

/// Where the nodes are: spread over the shape by sampling; at those vertices that remain of a mesh
/// after its simplification; on a regular grid over a flat shape (Sumner et al. 2007, Figure 5); or
/// as a file says.
enum class NodePlacement { kSampling, kSimplification, kGrid, kFile };
constexpr auto names_of(NodePlacement) {
  using enum NodePlacement;
  return std::to_array<EnumName<NodePlacement>>({{kSampling, "sampling"},
                                                 {kSimplification, "simplification"},
                                                 {kGrid, "grid"},
                                                 {kFile, "file"}});
}

/// How far a node is from a vertex: straight, as in the paper; along the surface of a manifold
/// mesh, by the heat method; along the edges of any mesh, which is many times faster on large ones;
/// or straight where the surface is nearly flat and along the edges where it goes a long way round
/// (geometry/transfer/path_aware.h).
enum class NodeDistance { kEuclidean, kGeodesic, kEdgePaths, kPathAware };
constexpr auto names_of(NodeDistance) {
  using enum NodeDistance;
  return std::to_array<EnumName<NodeDistance>>({{kEuclidean, "euclidean"},
                                                {kGeodesic, "geodesic"},
                                                {kEdgePaths, "edge_paths"},
                                                {kPathAware, "path_aware"}});
}

/// Where nodes are placed: over the whole shape, or only where an edit can move something. The
/// active part is what is not fixed, and a margin of the fixed part around it. Fixed vertices that
/// are farther away are not embedded.
enum class NodeRegion { kWhole, kActive };
constexpr auto names_of(NodeRegion) {
  using enum NodeRegion;
  return std::to_array<EnumName<NodeRegion>>({{kWhole, "whole"}, {kActive, "active"}});
}

/// The weight α_jk of an edge in Eq. 7: 1, as in the paper; in proportion to the overlap of
/// influence Σ_i w_j(v_i) w_k(v_i); or in proportion to ‖g_j − g_k‖⁻², so that bending costs the
/// same where a graph is dense and where it is not.
enum class EdgeWeights { kUniform, kOverlap, kLength };
constexpr auto names_of(EdgeWeights) {
  using enum EdgeWeights;
  return std::to_array<EnumName<EdgeWeights>>(
      {{kUniform, "uniform"}, {kOverlap, "overlap"}, {kLength, "length"}});
}

/// Whether a closed shape gets nodes inside as well (geometry/graph/placement/graph_interior.h).
/// With kAuto it gets them for edits in which neighbouring regions turn by more than a half turn
/// against each other.
enum class InteriorNodes { kOff, kAuto, kOn };
constexpr auto names_of(InteriorNodes) {
  using enum InteriorNodes;
  return std::to_array<EnumName<InteriorNodes>>({{kOff, "off"}, {kAuto, "auto"}, {kOn, "on"}});
}

/// How a deformation graph is made (Sumner et al. 2007, section 3).
struct GraphOptions {
  NodePlacement method = NodePlacement::kSampling;
  int nodes = 300;  ///< m, met exactly unless `fit` is set; a file has its own number
  /// Fits the graph to the shape. It has at most `nodes` nodes, and at most a quarter of the number
  /// of vertices (but at least 50, if there are so many vertices). Vertices without a face get
  /// nodes as well. Nodes that no vertex follows are left out. Nodes whose vertices an edge of the
  /// shape joins are joined, so that the graph of a connected part is connected.
  bool fit = false;
  NodeRegion region = NodeRegion::kWhole;
  std::filesystem::path file;  ///< of nodes and edges: an OBJ file of v and l lines
  double aspect_ratio = 3;     ///< circumradius over twice the inradius of simplified triangles
  NodeDistance distance = NodeDistance::kEuclidean;
  int neighbors = 4;  ///< k of Eq. 4; the paper uses 4, and 8 in Figure 5 (d)
  EdgeWeights alpha = EdgeWeights::kUniform;
  /// `build_graph` makes none of these nodes, because they may depend on the edit.
  InteriorNodes interior = InteriorNodes::kOff;
  double interior_spacing = 1.3;  ///< as in with_interior
  std::uint64_t seed = 1;         ///< another seed draws other samples

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("method", o.method,
          "How nodes are placed: spread over the shape, by simplifying its mesh, on a regular grid "
          "over a flat shape, or as a file says");
    visit.range("nodes", o.nodes, kNodeRange,
                "The number of nodes of the graph, which is met exactly unless fit is true");
    visit("fit", o.fit,
          "Whether the graph fits itself to the shape: no more nodes than a quarter of its "
          "vertices, nodes for points without faces too, none that no vertex follows, and a "
          "connected graph for every connected part");
    visit("region", o.region,
          "Where nodes are placed: over the whole shape, or only in the part that an edit can move "
          "and a margin around it");
    visit("file", o.file, "An OBJ file with the nodes (v lines) and edges (l lines) of the graph");
    visit.range("aspect_ratio", o.aspect_ratio, {.min = 1},
                "The greatest aspect ratio of a triangle that simplification may make; that of an "
                "equilateral triangle is 1");
    visit("distance", o.distance,
          "How the distance of a node and a vertex is measured: straight, along the surface of a "
          "manifold mesh, along the edges of any mesh (faster), or straight unless the way along "
          "the edges is much longer");
    visit.range("neighbors", o.neighbors, kNeighborRange,
                "The number of nodes that each vertex follows, k in Eq. 4 of Sumner et al. 2007");
    visit(
        "alpha", o.alpha,
        "The weight of an edge in Eq. 7 of Sumner et al. 2007: 1, in proportion to the overlap of "
        "the nodes' influence, or to length⁻², for graphs that are denser in some parts");
    visit(
        "interior", o.interior,
        "Whether a closed shape gets nodes inside too, which hold its volume where it is twisted. "
        "auto adds them where neighbouring regions turn by more than a half turn against each "
        "other");
    visit.range("interior_spacing", o.interior_spacing, {.min = 0.25, .max = 10},
                "The size of the cells of the grid on which nodes inside are, relative to the mean "
                "distance of neighbouring nodes on the surface");
    visit("seed", o.seed, "The seed of the random numbers for sampling nodes");
  }
};

/// An undirected edge between two nodes that influence a common vertex, or that a file joins. Eq. 7
/// sums over both of its directions.
struct GraphEdge {
  int j, k;      ///< j < k
  double alpha;  ///< α_jk, whose mean over all edges is one
};

/// Nodes with their positions at rest, and the edges over which their transformations must agree.
struct DeformationGraph {
  Eigen::Matrix3Xd g;            ///< 3×m node positions g_j [length]
  std::vector<GraphEdge> edges;  ///< sorted by (j, k), each once
};

/// Throws InputError for a node that is not finite, for an edge that names a node which does not
/// exist or the same node twice, and for an α that is negative or not finite.
void check(const DeformationGraph& graph);

/// Joins every two of the nodes `g` (3×m) that influence a common point of `embedding`, and gives
/// the edges their weights. Where some points follow fewer nodes than the embedding has rows,
/// `followed` gives for each point how many of its nodes count. Throws InputError where these do
/// not fit together. The functions below throw it for an edge to a node that does not exist.
DeformationGraph connect(const Eigen::Matrix3Xd& g, const Embedding& embedding,
                         EdgeWeights alpha = EdgeWeights::kUniform,
                         std::span<const int> followed = {});

/// Gives the edges of a graph weights in proportion to length⁻², with mean one. An edge of length
/// zero gets the weight of the shortest edge that is longer.
void weigh_by_length(DeformationGraph& graph);

/// Scales the weights of the edges to a mean of one; where their sum is zero, each becomes one.
void normalize_weights(DeformationGraph& graph);

/// The mean length of an edge [length], which is the default unit of E_reg and E_con. A graph
/// without edges gives the diagonal of the nodes' bounding box, and a single node gives 1.
double mean_edge_length(const DeformationGraph& graph);

/// The connected component of each node. Components are numbered from 0 in the order of their first
/// nodes.
std::vector<int> components(const DeformationGraph& graph);

}  // namespace deformlab
