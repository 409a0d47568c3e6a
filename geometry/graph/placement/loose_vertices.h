#pragma once

#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab {

/// The vertices that have no face, ascending.
inline std::vector<int> loose_vertices(const Shape& shape) {
  std::vector<char> has_face(static_cast<std::size_t>(shape.V.cols()), 0);
  for (const auto& face : shape.faces) {
    for (const int i : face) has_face[i] = 1;
  }
  std::vector<int> loose;
  for (std::size_t i = 0; i < has_face.size(); ++i) {
    if (!has_face[i]) loose.push_back(static_cast<int>(i));
  }
  return loose;
}

}  // namespace deformlab
