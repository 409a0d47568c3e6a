#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "drawing/local_motions.h"
#include "geometry/plane/locator.h"

namespace deformlab {

/// Points that follow a triangulation. Each keeps its barycentric coordinates in the triangle that
/// contains it (Igarashi et al. 2005, section 3).
///
/// A point outside of all triangles follows a smooth extension of their motion: the rigid motion
/// that fits the mesh best around the nearest place, over a reach that grows with the point's
/// distance (LocalMotions). In the middle between two limbs the nearest place jumps; therefore the
/// motions for the nearest places of all points in a neighbourhood are blended, whose radius also
/// grows with the distance. Close to the mesh, a point keeps its distance from it.
class Binding {
 public:
  Binding() = default;
  /// Points nearer to the mesh than `crisp` follow their nearest place alone [length]; a negative
  /// value stands for an eighth of an edge.
  Binding(const Triangulation& rest, const Locator& locator, const Eigen::Matrix2Xd& points,
          double crisp = -1);
  /// The same, but each point follows what is nearest to the place with its number (2×n), as if the
  /// triangle there went on to the point.
  Binding(const Triangulation& rest, const Locator& locator, const Eigen::Matrix2Xd& points,
          const Eigen::Matrix2Xd& places, double crisp = -1);

  /// The positions of the points (2×n) when the vertices are at V (2×#V).
  Eigen::Matrix2Xd operator()(const Eigen::Matrix2Xd& V) const;

  int triangle(Eigen::Index point) const { return triangle_[point]; }
  /// The distance of each point from the triangulation at rest [length].
  const Eigen::VectorXd& outside() const { return outside_; }

 private:
  class Blender;
  /// A point outside. It follows the motions begin … end − 1 of pulls_, and adds to them a share of
  /// what keeps its distance from the nearest place.
  struct Outside {
    Eigen::Index point;
    std::complex<double> rest, nearest;
    std::size_t begin, end;
    double adherence;
  };
  struct Pull {
    int motion;
    double weight;
  };

  Eigen::Matrix3Xi corners_;
  Eigen::VectorXi triangle_;
  Eigen::Matrix3Xd b_;  ///< barycentric coordinates of the point, or of the nearest place
  Eigen::VectorXd outside_;
  std::vector<Outside> beyond_;
  std::vector<Pull> pulls_;
  LocalMotions motions_;
};

/// The barycentric coordinates of any point for a triangle (2×3 corners, area not zero).
Eigen::Vector3d barycentric(const Eigen::Matrix<double, 2, 3>& corners,
                            const Eigen::Vector2d& point);

/// The corners of triangle f.
Eigen::Matrix<double, 2, 3> corners(const Eigen::Matrix2Xd& V, const Eigen::Matrix3Xi& F,
                                    Eigen::Index f);

}  // namespace deformlab
