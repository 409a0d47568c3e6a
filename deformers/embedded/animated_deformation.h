#pragma once

#include <span>
#include <vector>

#include "deformers/embedded/embedded_deformation.h"

namespace deformlab {

/// Embedded deformation of a mesh animation (Sumner et al. 2007, section 5, "Mesh animations"): the
/// nodes sit on vertices and go where these go from frame to frame, while edges and weights stay.
/// Each frame is deformed by itself, from its own rest state, so that it depends on no other.
class AnimatedDeformation {
 public:
  /// Builds the graph on one pose. Sampled nodes are moved to the nearest vertices, each to one of
  /// its own. Throws InputError as EmbeddedDeformation does, and where a node of a graph made by
  /// hand sits on no vertex.
  AnimatedDeformation(const Shape& pose, const EmbeddedDeformationOptions& options);

  /// Which vertices are held and which are moved, in all frames to come; no other places can be,
  /// as they would not follow the animation. Throws InputError.
  void compile(const Handles& handles);

  /// Takes the nodes along to a frame, which has the vertices of the pose, and moves its handles by
  /// the offsets (3×#moved) [length]. Throws InputError for another number of vertices or offsets.
  Report update(const Shape& frame, const Eigen::Matrix3Xd& offsets);

  /// The last frame, edited.
  const Shape& deformed() const { return deformation_.deformed(); }
  const EmbeddedDeformation& deformation() const { return deformation_; }
  const std::vector<int>& node_vertices() const { return node_vertices_; }  ///< of each node

 private:
  EmbeddedDeformation deformation_;
  std::vector<int> node_vertices_;
  Handles handles_;
};

}  // namespace deformlab
