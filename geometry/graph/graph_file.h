#pragma once

#include <filesystem>

#include "geometry/graph/deformation_graph.h"

namespace deformlab {

/// Reads a graph that was made by hand from an OBJ file: a line `v x y z` is a node [length], a
/// line `l a b …` joins each node that it names to the next (from 1, or from −1 backwards from the
/// newest one). Groups, names and materials are passed over. All α_jk are 1. Throws InputError,
/// naming line and node, for a node at the place of another or without an edge (unless it is the
/// only one), one too far away to compute with, an edge to a node that does not exist, to itself or
/// given twice, a face, and where the file cannot be read or holds no node.
DeformationGraph read_graph(const std::filesystem::path& path);

}  // namespace deformlab
