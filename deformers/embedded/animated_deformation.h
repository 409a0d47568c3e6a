#pragma once

#include <span>
#include <vector>

#include "deformers/embedded/embedded_deformation.h"

namespace deformlab {

/// Embedded deformation of a mesh animation (Sumner et al. 2007, section 5, "Mesh animations"). The
/// nodes are at vertices and move with them from frame to frame, while edges and weights stay. Each
/// frame is deformed from its own rest state, so that it does not depend on any other frame.
///
/// Where nothing is fixed and the handles are nearly on a line, they do not tell how the shape
/// rolls about it, and each frame would roll as it likes. With `hold_angles` such handles turn with
/// the line on the shortest way, so that the shape rolls as the input does.
class AnimatedDeformation {
 public:
  /// Builds the graph on one pose. Sampled nodes are moved to the nearest vertices, each to a
  /// vertex of its own. Throws InputError as EmbeddedDeformation does, and for a graph made by hand
  /// with a node that does not sit on a vertex.
  AnimatedDeformation(const Shape& pose, const EmbeddedDeformationOptions& options);

  /// Sets which vertices are fixed and which are moved in all frames that follow. Throws InputError
  /// for handles that are not vertices, because they would not follow the animation.
  void compile(const Handles& handles);

  /// Moves the nodes to a frame, which has the vertices of the pose, and the frame's handles by the
  /// offsets (3×#moved) [length]. `rotations` says how the handles turn in this frame, as in
  /// Handles. Throws InputError for another number of vertices, offsets or rotations.
  Report update(const Shape& frame, const Eigen::Matrix3Xd& offsets,
                const Eigen::Matrix3Xd& rotations = Eigen::Matrix3Xd(3, 0));

  /// The last frame, deformed.
  const Shape& deformed() const { return deformation_.deformed(); }
  const EmbeddedDeformation& deformation() const { return deformation_; }
  /// The vertex at each node.
  const std::vector<int>& node_vertices() const { return node_vertices_; }

 private:
  void find_node_vertices();
  void find_lines();
  Eigen::Matrix3Xd with_lines(const Eigen::Matrix3Xd& rotations, const Eigen::Matrix3Xd& rest,
                              const Eigen::Matrix3Xd& targets) const;

  Shape pose_;
  EmbeddedDeformation deformation_;
  std::vector<int> node_vertices_;
  Handles handles_;
  std::vector<std::vector<int>> lines_;  // handles that are nearly on a line and hold all of a part
};

}  // namespace deformlab
