#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "deformers/arap_2d/handle_clusters.h"
#include "deformers/arap_2d/registered_mesh.h"
#include "geometry/plane/barycentric_point.h"

namespace deformlab {

/// The handles of a connected mesh.
struct MeshHandles {
  std::vector<BarycentricPoint> points;  ///< their vertices are in the registered mesh's order
  std::vector<HandleCluster> clusters;   ///< the clusters of these points
  /// Whether the handles are at two points or more. Only then they determine a rotation of the
  /// mesh, and there is a step one.
  bool distinct;

  /// The number of independent conditions that the handles impose.
  Eigen::Index rank() const {
    Eigen::Index sum = 0;
    for (const HandleCluster& cluster : clusters) sum += cluster.rank();
    return sum;
  }
};

/// The two linear systems of the paper, compiled for the handles of a connected mesh. Targets q
/// (one for each handle) and positions (in the registered mesh's order) are complex numbers.
/// Only `intermediate` allocates memory.
class HandleSystem {
 public:
  virtual ~HandleSystem() = default;
  /// Step one (section 4.1), as far as the fitting needs it.
  virtual void step_one(const Eigen::VectorXcd& q) = 0;
  /// Fitting (section 4.2.1): sets the triangles' rotations to those of step one's result.
  virtual void fit(TriangleFit& triangles) const = 0;
  /// Step two (section 4.2.2): z is b of TriangleFit::assemble and becomes the positions v''.
  virtual void step_two(const Eigen::VectorXcd& q, Eigen::VectorXcd& z) = 0;
  /// The positions v' of the last step one.
  virtual Eigen::VectorXcd intermediate() const = 0;
};

/// Makes a system for few handles. It uses Schur complements S = C G⁻¹ Cᴴ and the factors of the
/// registration. A compilation then costs one or two solves for each handle, and the fitting of an
/// update needs no positions v'.
std::unique_ptr<HandleSystem> make_schur_complement_system(const RegisteredMesh& mesh,
                                                           const MeshHandles& handles);

/// Makes a system for many handles. It factorizes the paper's G' and H', from which the handles are
/// eliminated. Throws InputError where they are singular.
std::unique_ptr<HandleSystem> make_elimination_system(const RegisteredMesh& mesh,
                                                      const MeshHandles& handles);

}  // namespace deformlab
