#pragma once

// What turns with the vertices of a shape, besides their normals.

#include "geometry/shape/formats/numbers.h"

namespace deformlab::formats {

/// The edits that turn the attributes and the corners' normals of a file when its vertices move to
/// V (3×#V), each by the local rotation of its vertex.
std::vector<Edit> turn(std::string_view bytes, const ShapeFile& file, const Eigen::Matrix3Xd& V);

}  // namespace deformlab::formats
