#include "geometry/shape/shape.h"

#include <Eigen/Geometry>
#include <cmath>
#include <sstream>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

[[noreturn]] void reject(const std::string& name, const std::string& what) {
  throw InputError("cannot use '" + name + "': " + what);
}

void check_finite(const Eigen::Matrix3Xd& columns, const char* kind, const std::string& name) {
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    if (columns.col(i).allFinite()) continue;
    std::ostringstream what;
    what << "vertex " << i << " (counted from 0) has the " << kind << " ("
         << columns.col(i).transpose() << "); every number must be finite";
    reject(name, what.str());
  }
}

// The fourth power of a length, which occurs in areas and energies, must be in a double's range.
void check_scale(const Eigen::Matrix3Xd& V, const std::string& name) {
  const double across = bounding_box_diagonal(V);
  const double farthest = V.cwiseAbs().maxCoeff();
  const bool usable = across == 0 || (across >= kLeastLength && across <= kMostLength);
  if (usable && farthest <= kMostLength) return;
  std::ostringstream what;
  what << "it is " << across << " across and reaches " << farthest
       << " from the origin; allowed are " << kLeastLength << " to " << kMostLength << ": scale it";
  reject(name, what.str());
}

void check_faces(const Shape& shape, const std::string& name) {
  const Eigen::Index count = shape.V.cols();
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    for (const int v : shape.faces[f]) {
      if (v >= 0 && v < count) continue;
      reject(name, "face " + std::to_string(f) + " names vertex " + std::to_string(v) +
                       " (both counted from 0), but there are " + std::to_string(count) +
                       " vertices");
    }
  }
}

}  // namespace

void check(const Shape& shape, const std::string& name) {
  if (shape.V.cols() == 0) reject(name, "it has no vertices");
  if (shape.N.cols() != 0 && shape.N.cols() != shape.V.cols()) {
    reject(name, "it has " + std::to_string(shape.N.cols()) + " normals for " +
                     std::to_string(shape.V.cols()) + " vertices; allowed are none or one each");
  }
  check_finite(shape.V, "position", name);
  check_finite(shape.N, "normal", name);
  check_scale(shape.V, name);
  check_faces(shape, name);
}

Eigen::Matrix3Xi triangles(const Shape& shape) {
  Eigen::Index count = 0;
  for (const auto& face : shape.faces) {
    if (face.size() >= 3) count += static_cast<Eigen::Index>(face.size()) - 2;
  }
  Eigen::Matrix3Xi result(3, count);
  Eigen::Index t = 0;
  for (const auto& face : shape.faces) {
    for (std::size_t c = 2; c < face.size(); ++c) {
      result.col(t++) = Eigen::Vector3i(face[0], face[c - 1], face[c]);
    }
  }
  return result;
}

Eigen::Matrix3Xd vertex_normals(const Shape& shape) {
  Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, shape.V.cols());
  const Eigen::Matrix3Xi corners = triangles(shape);
  for (Eigen::Index t = 0; t < corners.cols(); ++t) {
    const Eigen::Vector3d a = shape.V.col(corners(0, t));
    const Eigen::Vector3d twice_area =
        (shape.V.col(corners(1, t)) - a).cross(shape.V.col(corners(2, t)) - a);
    for (int c = 0; c < 3; ++c) normals.col(corners(c, t)) += twice_area;
  }
  for (Eigen::Index i = 0; i < normals.cols(); ++i) normals.col(i).stableNormalize();
  return normals;
}

double bounding_box_diagonal(const Eigen::Matrix3Xd& V) {
  if (V.cols() == 0) return 0;
  return (V.rowwise().maxCoeff() - V.rowwise().minCoeff()).stableNorm();
}

}  // namespace deformlab
