#include "geometry/graph/graph_cut.h"

#include <algorithm>
#include <map>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

// For each cut the side that a vertex is on: 'a', 'b', or ' ' for neither.
using Sides = std::string;

void enter(const Cut& cut, const std::vector<int>& vertices, char side, std::size_t c,
           std::vector<Sides>& sides) {
  if (vertices.empty()) throw InputError(cut.name + ": its side " + side + " has no vertex");
  for (const int i : vertices) {
    if (i < 0 || i >= std::ssize(sides)) {
      throw InputError(cut.name + ": vertex " + std::to_string(i) +
                       " does not exist; the shape has " + std::to_string(sides.size()) +
                       " vertices, counted from 0");
    }
    char& entry = sides[i][c];
    if (entry != ' ' && entry != side) {
      throw InputError(cut.name + ": vertex " + std::to_string(i) +
                       " is on both sides; take it out of one");
    }
    entry = side;
  }
}

std::vector<Sides> sides_of(Eigen::Index vertices, std::span<const Cut> cuts) {
  std::vector<Sides> sides(static_cast<std::size_t>(vertices), Sides(cuts.size(), ' '));
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    enter(cuts[c], cuts[c].a, 'a', c, sides);
    enter(cuts[c], cuts[c].b, 'b', c, sides);
  }
  return sides;
}

bool are_apart(const Sides& one, const Sides& other) {
  for (std::size_t c = 0; c < one.size(); ++c) {
    if (one[c] != ' ' && other[c] != ' ' && one[c] != other[c]) return true;
  }
  return false;
}

void reject_without_node(const CutGroups& groups, std::size_t g, const Sides& sides,
                         std::span<const Cut> cuts) {
  const auto of_vertex = groups.of_vertex.begin();
  const auto first = std::find(of_vertex, groups.of_vertex.end(), static_cast<int>(g));
  const auto count = std::count(of_vertex, groups.of_vertex.end(), static_cast<int>(g));
  std::string names;
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    if (sides[c] != ' ') names += (names.empty() ? "" : " and ") + cuts[c].name;
  }
  const std::string vertex = "vertex " + std::to_string(first - of_vertex);
  const std::string who =
      count == 1 ? vertex : std::to_string(count) + " vertices, the first of them " + vertex + ",";
  const std::size_t nodes = groups.of_node.size();
  throw InputError(
      names + ": " + who + " would have no node to follow: " +
      (nodes == 1 ? "the one node is" : "all " + std::to_string(nodes) + " nodes are") +
      " on the other side; use more nodes, or cut off less");
}

}  // namespace

CutGroups group(Eigen::Index vertices, std::span<const int> node_vertices,
                std::span<const Cut> cuts) {
  CutGroups groups;
  std::map<Sides, int> number;
  std::vector<Sides> known;  // sides of each group
  for (const Sides& sides : sides_of(vertices, cuts)) {
    const auto [at, is_new] = number.try_emplace(sides, static_cast<int>(known.size()));
    if (is_new) known.push_back(sides);
    groups.of_vertex.push_back(at->second);
  }
  for (const int v : node_vertices) groups.of_node.push_back(groups.of_vertex[v]);
  for (std::size_t g = 0; g < known.size(); ++g) {
    std::vector<char>& apart = groups.apart.emplace_back();
    for (const Sides& other : known) apart.push_back(are_apart(known[g], other));
    std::vector<int>& nodes = groups.nodes.emplace_back();
    for (std::size_t j = 0; j < node_vertices.size(); ++j) {
      if (!apart[groups.of_node[j]]) nodes.push_back(static_cast<int>(j));
    }
    if (nodes.empty() && !cuts.empty()) reject_without_node(groups, g, known[g], cuts);
  }
  return groups;
}

}  // namespace deformlab
