#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "deformers/arap_2d/connectivity.h"
#include "geometry/plane/barycentric_point.h"

namespace deformlab {

/// How a component of a mesh can move, which depends on its handles.
enum class ComponentMotion {
  kNone,         ///< it has no handle and stays at rest
  kTranslation,  ///< all its handles are at one point, and it moves there without turning
  kDeformation,  ///< it has handles at two points or more
};

ComponentMotion motion_of(bool has_handles, bool handles_are_distinct);

/// The positions V (2×#V) as numbers x + iy.
Eigen::VectorXcd all_to_complex(const Eigen::Matrix2Xd& V);

/// The greatest distance of one of the positions p (#V) from the first [length].
double extent_of(const Eigen::VectorXcd& p);

/// Whether the points are at two positions or more when the vertices are at rest at p (#V). A
/// distance of less than 1e-9 of the extent counts as 0.
bool are_distinct(const std::vector<BarycentricPoint>& points, const Eigen::VectorXcd& p,
                  double extent);

/// Gathers what a user should know about components that cannot deform. The first few are named,
/// the others are counted.
class MotionNotes {
 public:
  void add(const MeshComponent& component, ComponentMotion motion);
  /// One sentence each.
  std::vector<std::string> notes() const;

 private:
  std::vector<std::string> named_;
  int others_ = 0;
};

}  // namespace deformlab
