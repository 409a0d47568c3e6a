#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/IO/read_xyz_points.h>
#include <CGAL/Simple_cartesian.h>

#include <locale>
#include <sstream>

#include "geometry/shape/shape_formats.h"

namespace deformlab::formats {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Points = std::vector<Kernel::Point_3>;
using Polygons = std::vector<std::vector<int>>;

void store(const Points& points, Shape& shape) {
  shape.V.resize(3, static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index i = 0; i < shape.V.cols(); ++i) {
    const Kernel::Point_3& p = points[static_cast<std::size_t>(i)];
    shape.V.col(i) << p.x(), p.y(), p.z();
  }
}

template <class Read>
bool parse(const std::string& plain, Shape& shape, Read&& read) {
  std::istringstream stream(plain, std::ios::binary);
  stream.imbue(std::locale::classic());
  Points points;
  const bool ok = read(stream, points, shape.faces);
  store(points, shape);
  return ok;
}

}  // namespace

bool parse_off(const std::string& plain, Shape& shape) {
  return parse(plain, shape, [](std::istream& in, Points& points, Polygons& faces) {
    return CGAL::IO::read_OFF(in, points, faces);
  });
}

bool parse_obj(const std::string& plain, Shape& shape) {
  return parse(plain, shape, [](std::istream& in, Points& points, Polygons& faces) {
    // CGAL calls a file without faces a failure, though it has read the points.
    return CGAL::IO::read_OBJ(in, points, faces) || faces.empty();
  });
}

bool parse_ply(const std::string& plain, Shape& shape) {
  return parse(plain, shape, [](std::istream& in, Points& points, Polygons& faces) {
    return CGAL::IO::read_PLY(in, points, faces);
  });
}

bool parse_stl(const std::string& plain, Shape& shape) {
  return parse(plain, shape, [](std::istream& in, Points& points, Polygons& faces) {
    return CGAL::IO::read_STL(in, points, faces);
  });
}

bool parse_xyz(const std::string& plain, Shape& shape) {
  return parse(plain, shape, [](std::istream& in, Points& points, Polygons&) {
    return CGAL::IO::read_XYZ(in, std::back_inserter(points));
  });
}

}  // namespace deformlab::formats
