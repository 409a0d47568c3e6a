#pragma once

#include "geometry/graph/deformation_graph.h"
#include "geometry/graph/graph_build.h"
#include "geometry/shape/weld.h"
#include "geometry/transfer/embedding.h"

// What makes a graph fit its shape (GraphOptions::fit).
namespace deformlab {

/// The number of nodes for a surface: at most `most`, and at most a quarter of the vertices, but at
/// least 50 if there are so many vertices. More nodes on a coarse mesh would each move few vertices
/// and tear them apart.
int fitting_nodes(const WeldedSurface& surface, int most);

/// Joins the nodes that are nearest to the two ends of every edge of the surface. Afterwards the
/// graph is connected on every connected part of the shape. Returns whether an edge was added; it
/// has the least weight of the others.
bool join_along_surface(const WeldedSurface& surface, const Embedding& embedding,
                        DeformationGraph& graph);

/// Leaves out the nodes that no vertex of the embedding follows, because nothing holds them. The
/// vertices of the nodes that stay are kept in `built`.
void leave_out_idle_nodes(BuiltGraph& built, Embedding& embedding);

}  // namespace deformlab
