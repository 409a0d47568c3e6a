#pragma once

#include <complex>
#include <vector>

#include "drawing/local_motions.h"
#include "geometry/plane/locator.h"
#include "geometry/plane/region.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// Meshes for the detached parts of a drawing, whose edges are about as long as those of its mesh.
/// Very small parts, and all but the largest few hundred, get no mesh: they follow what is nearest
/// as the rim of the drawing does (Binding).
std::vector<Triangulation> meshes_of(const std::vector<Region>& parts, const Triangulation& rest);

/// The parts of a drawing that are apart from its mesh and follow it as if they were attached. Each
/// part has a mesh for its pixels and curves. It is attached to what is nearest to it, which is the
/// mesh or another part, where the gap between both is narrow, and moves as the other one does
/// there: rigidly if the gap is narrow at one place only, and bending if it is narrow along the
/// part.
class FollowingParts {
 public:
  FollowingParts() = default;
  FollowingParts(const Triangulation& rest, std::vector<Triangulation> parts);

  /// The mesh, and after it the meshes of the parts, at rest.
  const Triangulation& all() const { return all_; }
  /// The positions of all vertices when those of the mesh are at V (2×#V).
  Eigen::Matrix2Xd operator()(const Eigen::Matrix2Xd& V) const;
  /// The depths of all triangles when those of the mesh are `depth` (#F, or of size 0 for none).
  Eigen::VectorXd depths(const Eigen::VectorXd& depth) const;

 private:
  /// The mesh of the drawing or of a part.
  struct Piece {
    Triangulation mesh;
    Locator locate;
    LocalMotions motions;  ///< those that other parts follow
    Eigen::Index first_vertex, first_triangle;
  };
  /// A motion that a vertex follows, about a place at rest.
  struct Pull {
    int motion;
    double weight;
    std::complex<double> place;
  };
  /// How a piece follows an earlier one.
  struct Follower {
    int leader;
    int triangle;  ///< of the leader, at the narrowest place of the gap
    std::vector<std::vector<Pull>> pulls;
  };
  struct Gap;

  void add(Triangulation mesh);
  void attach(const Gap& gap, Triangulation part);

  std::vector<Piece> pieces_;        ///< the mesh of the drawing, then those of its parts
  std::vector<Follower> followers_;  ///< of each piece but the first
  Triangulation all_;
};

}  // namespace deformlab
