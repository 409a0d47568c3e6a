#pragma once

#include <filesystem>

#include "geometry/graph/deformation_graph.h"

namespace deformlab {

/// Reads a graph that was made by hand from an OBJ file. A line `v x y z` is a node [length]; a
/// line `l a b …` joins each node that it names to the next. Nodes are numbered from 1, and
/// backwards from −1, which is the newest node. Groups, names and materials are ignored. All α_jk
/// are 1. Throws InputError, which names the line and the node, for a node at the position of
/// another, without an edge (unless it is the only node) or too far away to compute with; for an
/// edge to a node that does not exist or to itself, and a repeated edge; for a face; and where the
/// file cannot be read or has no node.
DeformationGraph read_graph(const std::filesystem::path& path);

}  // namespace deformlab
