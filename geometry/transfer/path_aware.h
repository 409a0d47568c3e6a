#pragma once

#include <span>

#include "geometry/shape/weld.h"
#include "geometry/transfer/geodesic.h"

namespace deformlab {

/// The `count` sources (vertices) that are nearest to each vertex by the greater of the straight
/// distance and 0.8 times the shortest path over the surface. A path along edges is longer than the
/// shortest way on the surface, by an amount that depends on its direction. The factor makes the
/// straight distance count wherever the surface is nearly flat, so that influences stay smooth. A
/// path counts only where it goes a long way round, so that a finger does not follow its neighbour.
///
/// Vertices at one place of the surface get the same sources, so that seams stay closed.
/// Between parts of a shape that no path joins the straight distance counts, so that eyes, hair and
/// buttons follow what they touch. A point set has only straight distances.
///
/// On a large mesh, paths are measured between a few thousand of its vertices, and every other
/// vertex reaches them along a straight line, so that the time is proportional to the size of the
/// mesh.
NearestSources nearest_path_aware(const WeldedSurface& surface, std::span<const int> sources,
                                  int count);

}  // namespace deformlab
