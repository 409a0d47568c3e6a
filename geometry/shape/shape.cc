#include "geometry/shape/shape.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <sstream>

#include "geometry/core/error.h"
#include "geometry/shape/usable.h"

namespace deformlab {
namespace {

void check_finite(const Eigen::Matrix3Xd& columns, const char* kind, const std::string& name) {
  if (columns.allFinite()) return;  // many times faster than column by column
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    if (columns.col(i).allFinite()) continue;
    std::ostringstream what;
    what << "vertex " << i << " (counted from 0) has the " << kind << " ("
         << columns.col(i).transpose() << "); every number must be finite";
    cannot_use(name, what.str());
  }
}

void check_faces(const Shape& shape, const std::string& name) {
  const Eigen::Index count = shape.V.cols();
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    for (const int v : shape.faces[f]) {
      if (v >= 0 && v < count) continue;
      cannot_use(name,
                 fmt::format("face {} names vertex {} (both counted from 0), but there are {} "
                             "vertices",
                             f, v, count));
    }
  }
}

}  // namespace

void cannot_use(const std::string& name, const std::string& what) {
  throw InputError(fmt::format("cannot use '{}': {}", name, what));
}

void check_extent(const Eigen::Ref<const Eigen::MatrixXd>& points, const std::string& name) {
  const double across = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).stableNorm();
  const double farthest = points.cwiseAbs().maxCoeff();
  const bool usable = across == 0 || (across >= kLeastLength && across <= kMostLength);
  if (usable && farthest <= kMostLength) return;
  cannot_use(name,
             fmt::format("it is {:g} across and reaches {:g} from the origin; allowed are {:g} "
                         "to {:g}: scale it",
                         across, farthest, kLeastLength, kMostLength));
}

void check(const Shape& shape, const std::string& name) {
  if (shape.V.cols() == 0) cannot_use(name, "it has no vertices");
  if (shape.N.cols() != 0 && shape.N.cols() != shape.V.cols()) {
    cannot_use(name, fmt::format("it has {} normals for {} vertices; allowed are none or one each",
                                 shape.N.cols(), shape.V.cols()));
  }
  check_finite(shape.V, "position", name);
  check_finite(shape.N, "normal", name);
  check_extent(shape.V, name);
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
  if (count > 0 && (result.minCoeff() < 0 || result.maxCoeff() >= shape.V.cols())) {
    check_faces(shape, "the shape");  // throws
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
