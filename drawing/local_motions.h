#pragma once

#include <Eigen/Core>
#include <complex>
#include <map>
#include <utility>
#include <vector>

#include "geometry/plane/triangulation.h"

namespace deformlab {

/// A rigid motion of points x + iy.
struct RigidMotion {
  std::complex<double> turn = 1, from = 0, to = 0;  ///< |turn| = 1

  std::complex<double> operator()(const std::complex<double>& x) const {
    return to + turn * (x - from);
  }
};

/// How a mesh moves around its vertices: the rigid motions that fit it best there, by least squares
/// whose weights fall to 0 at a distance along the mesh (Schaefer, McPhail and Warren 2006 do the
/// same with straight distances). Parts of a mesh that only lie beside each other therefore do not
/// influence each other. A motion of level l reaches 2^(l+1) mean edge lengths far, and at least
/// over the triangles at the vertex, but over no more than a few hundred vertices.
class LocalMotions {
 public:
  LocalMotions() = default;
  /// Copies the mesh.
  explicit LocalMotions(const Triangulation& rest);

  /// The number of the motion around a vertex, which is prepared when it is first asked for.
  int number(int vertex, int level);
  /// The motions with the vertices at V (2×#V), by their numbers.
  std::vector<RigidMotion> operator()(const Eigen::Matrix2Xd& V) const;

  double edge() const { return edge_; }  ///< mean length of the edges at rest [length]

 private:
  struct Near {
    double distance;
    int vertex;
  };
  /// One motion: its vertices are entries begin … end − 1 of vertices_, weights_ and arms_.
  struct Fit {
    std::size_t begin, end;
    std::complex<double> center;
  };

  const std::vector<Near>& around(int vertex);
  double reach(int vertex, int level);
  int fit(int vertex, int level);

  Eigen::VectorXcd rest_;
  std::vector<std::vector<int>> neighbours_;
  double edge_ = 0;
  std::map<int, std::vector<Near>> around_;
  std::map<std::pair<int, int>, int> number_;
  std::vector<Fit> fits_;
  std::vector<int> vertices_;
  std::vector<double> weights_;             ///< with sum 1 over a fit
  std::vector<std::complex<double>> arms_;  ///< weight × conjugate of the way from the centre
};

/// The columns of V (2×n) as numbers x + iy.
Eigen::Map<const Eigen::VectorXcd> as_complex(const Eigen::Matrix2Xd& V);

}  // namespace deformlab
