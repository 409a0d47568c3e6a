#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/shape/shape.h"
#include "geometry/transfer/geodesic.h"

namespace deformlab {

/// A straight way between two vertices of a surface.
struct Link {
  int a, b;
  double length;  ///< [length]
};

/// The ways of a surface with the positions V (3×#V) [length] and the triangles T (3×#T): its
/// edges, and the straight lines across pairs of triangles with a common edge.
std::vector<Link> surface_links(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T);

/// The links that start at each vertex.
class Roads {
 public:
  Roads(Eigen::Index vertices, const std::vector<Link>& links);

  struct Road {
    int to;
    double length;
  };
  std::span<const Road> from(int vertex) const {
    return std::span(roads_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
  }
  double mean_length() const;  ///< [length], or 1 where all are 0
  Eigen::Index vertices() const { return static_cast<Eigen::Index>(first_.size()) - 1; }

 private:
  std::vector<std::size_t> first_;
  std::vector<Road> roads_;
};

/// The `count` sources (vertices) that are nearest to each vertex along the roads. One search of
/// Dijkstra's from all sources at once stays local, so that its time does not grow with the number
/// of sources.
NearestSources nearest_by_roads(const Roads& roads, std::span<const int> sources, int count);

}  // namespace deformlab
