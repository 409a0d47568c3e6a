#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "geometry/shape/shape.h"
#include "geometry/transfer/embedding.h"

namespace deformlab {

/// A graph that is refined where an edit needs it (Sumner et al. 2007, section 6).
struct AdaptiveOptions {
  int start = 0;   ///< nodes to begin with, GraphOptions::nodes being those at the end; 0: not so
  int rounds = 4;  ///< in how many refinements

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("start", o.start, "nodes to begin with, of graph.nodes at the end; 0: all at once");
    visit("rounds", o.rounds, "in how many steps the others are added, each where the last failed");
  }
};

/// How a deformation graph is made (Sumner et al. 2007, section 3).
struct GraphOptions {
  /// Where the nodes are: spread by `sampling`; those vertices that remain of a mesh after its
  /// `simplification`; a regular `grid` over a flat shape (Figure 5); given in a `file`.
  std::string method = "sampling";
  int nodes = 300;             ///< m, met exactly; a file has its own
  std::filesystem::path file;  ///< of nodes and edges, an OBJ of v and l lines
  double aspect_ratio = 3;     ///< of simplification: circumradius over twice the inradius, at most
  /// How far a node is from a vertex: straight (`euclidean`, the paper's), along the surface of a
  /// manifold mesh (`geodesic`, by the heat method), or along the edges of any mesh (`edge_paths`,
  /// which is many times faster on large ones).
  std::string distance = "euclidean";
  int neighbors = 4;  ///< k of Eq. 4; the paper uses 4, and 8 in Figure 5 (d)
  /// α_jk of Eq. 7: uniform (1, the paper's), overlap (of influence), or length, in proportion to
  /// ‖g_j − g_k‖⁻², so that bending costs the same where a graph is dense and where it is not.
  std::string alpha = "uniform";
  std::uint64_t seed = 1;  ///< of the sampling: another seed draws other nodes
  AdaptiveOptions adaptive;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.choice("method", o.method, {"sampling", "simplification", "grid", "file"},
                 "how nodes are placed: spread over the shape, by simplifying a mesh, on a regular "
                 "grid over a flat shape, or by hand");
    visit("nodes", o.nodes, "number of graph nodes m, met exactly");
    visit("file", o.file, "a graph made by hand: an OBJ file of v and l lines");
    visit("aspect_ratio", o.aspect_ratio,
          "of the triangles of a simplification at most; 1 is equilateral");
    visit.choice("distance", o.distance, {"euclidean", "geodesic", "edge_paths"},
                 "of nodes and vertices: straight, along the surface of a manifold mesh, or along "
                 "the edges of any mesh (faster)");
    visit("neighbors", o.neighbors, "nodes that each vertex follows, k of Eq. 4");
    visit.choice("alpha", o.alpha, {"uniform", "overlap", "length"},
                 "weight of an edge in Eq. 7: 1, in proportion to the overlap of influence, or to "
                 "length⁻², for graphs that are denser in places");
    visit("seed", o.seed, "of the node sampling");
    visit("adaptive", o.adaptive, "nodes that are added where an edit turns out to need them");
  }
};

/// Undirected edge between two nodes that influence a common vertex, or that were joined by hand;
/// Eq. 7 takes it both ways.
struct GraphEdge {
  int j, k;      ///< j < k
  double alpha;  ///< α_jk, of mean one over all edges
};

/// Nodes with a place at rest, and the edges over which their transformations must agree.
struct DeformationGraph {
  Eigen::Matrix3Xd g;            ///< 3×m node positions g_j [length]
  std::vector<GraphEdge> edges;  ///< sorted by (j, k), each once
};

/// Joins every two of the nodes `g` (3×m) that influence a common point of `embedding`, and weighs
/// the edges as `alpha` says: "uniform", "overlap" for Σ_i w_j(v_i) w_k(v_i), or "length" for
/// ‖g_j − g_k‖⁻². Where some points follow fewer nodes than there are rows, `followed` says of each
/// point how many of them count.
DeformationGraph connect(const Eigen::Matrix3Xd& g, const Embedding& embedding,
                         const std::string& alpha = "uniform", std::span<const int> followed = {});

/// Weighs edges that are there already by length⁻², with mean one; one of no length like the
/// shortest of the others.
void weigh_by_length(DeformationGraph& graph);

/// Scales the weights of edges to a mean of one; where they sum up to nothing, each becomes one.
void normalize_weights(DeformationGraph& graph);

/// Mean length of an edge [length]; without edges the diagonal of the nodes' bounding box, and for
/// a single point 1: the unit that E_reg and E_con are measured in by default.
double mean_edge_length(const DeformationGraph& graph);

/// The connected component of each node, numbered from 0 in the order of their first nodes.
std::vector<int> components(const DeformationGraph& graph);

}  // namespace deformlab
