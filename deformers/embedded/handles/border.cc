#include "deformers/embedded/handles/border.h"

#include <algorithm>

#include "deformers/embedded/handles/pins.h"

namespace deformlab {
namespace {

bool is_embedded(const FixedPart& part, int vertex) {
  return part.active.empty() || std::ranges::binary_search(part.active, vertex);
}

void mark(const Embedding& of, Eigen::Index column, char value, std::vector<char>& nodes) {
  for (Eigen::Index a = 0; a < of.nodes.rows(); ++a) {
    if (of.weights(a, column) > 0) nodes[of.nodes(a, column)] = value;
  }
}

}  // namespace

std::vector<char> fixed_nodes(const FixedPart& part, const Embedding& points, Border border,
                              Eigen::Index m) {
  std::vector<char> result(static_cast<std::size_t>(m), 0);
  std::vector<char> is_free(static_cast<std::size_t>(part.vertices.v.cols()), 1);
  for (const int i : part.fixed) {
    is_free[i] = 0;
    if (is_embedded(part, i)) mark(part.vertices, i, 1, result);
  }
  if (border == Border::kEliminate || part.fixed.empty()) return result;
  for (std::size_t i = 0; i < is_free.size(); ++i) {
    if (is_free[i]) mark(part.vertices, static_cast<Eigen::Index>(i), 0, result);
  }
  for (Eigen::Index l = 0; l < points.v.cols(); ++l) mark(points, l, 0, result);
  return result;
}

std::vector<int> border_vertices(const FixedPart& part, const std::vector<char>& fixed_nodes) {
  std::vector<int> result;
  for (const int i : part.fixed) {
    if (!is_embedded(part, i)) continue;
    if (influence_of_free(part.vertices, i, fixed_nodes) > 0) result.push_back(i);
  }
  return result;
}

}  // namespace deformlab
