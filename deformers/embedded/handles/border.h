#pragma once

#include <span>
#include <vector>

#include "deformers/embedded/embedded_options.h"
#include "geometry/transfer/embedding.h"

namespace deformlab {

/// The vertices of a shape that a graph moves, and which of them are fixed.
struct FixedPart {
  const Embedding& vertices;    ///< of the whole shape
  std::span<const int> active;  ///< the vertices that follow the graph, ascending; empty: all
  std::span<const int> fixed;   ///< vertices
};

/// Which of the m nodes stay at rest: those that influence a fixed vertex (Sumner et al. 2007, Eq.
/// 9), and with a soft border only those that influence neither a free vertex nor a point that is a
/// handle.
std::vector<char> fixed_nodes(const FixedPart& part, const Embedding& points, Border border,
                              Eigen::Index m);

/// The fixed vertices that follow a node that is not fixed. At a soft border they are handles.
std::vector<int> border_vertices(const FixedPart& part, const std::vector<char>& fixed_nodes);

}  // namespace deformlab
