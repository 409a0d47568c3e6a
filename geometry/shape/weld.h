#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab {

/// For each of the positions V (3×#V) [length], the first vertex at exactly the same position.
std::vector<int> weld(const Eigen::Ref<const Eigen::Matrix3Xd>& V);

/// The surface of a shape. Files often repeat vertices along seams, where texture coordinates or
/// normals change. Vertices at exactly the same position are one place of the surface here, and the
/// first of them stands for all. The places are found when they are first asked for, so that only
/// one thread may use an object.
class WeldedSurface {
 public:
  /// The shape must outlive this object.
  explicit WeldedSurface(const Shape& shape) : shape_(shape) {}

  const Shape& shape() const { return shape_; }
  /// For each vertex, the first one at its place.
  const std::vector<int>& first() const;
  int places() const;

  /// The triangles of the shape (3×#T), with the first vertex of each place.
  Eigen::Matrix3Xi welded_triangles() const;
  /// The connected part of the surface to which each vertex belongs, for the triangles
  /// `welded_triangles`. Parts are numbered from 0 in the order of their first vertices.
  std::vector<int> parts(const Eigen::Matrix3Xi& T) const;

 private:
  const Shape& shape_;
  mutable std::optional<std::vector<int>> first_;
};

}  // namespace deformlab
