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
  std::vector<HandleCluster> clusters;   ///< of these points
  /// Whether the handles are not all at one point: only then they say how the mesh is turned, and
  /// there is a step one.
  bool distinct;

  /// How many independent conditions the handles are.
  Eigen::Index rank() const {
    Eigen::Index sum = 0;
    for (const HandleCluster& cluster : clusters) sum += cluster.rank();
    return sum;
  }
};

/// The two linear systems of the paper, compiled for the handles of a connected mesh. Targets q are
/// complex numbers, one for each handle; positions are complex too, in the registered mesh's order.
/// Only `intermediate` allocates memory.
class HandleSystem {
 public:
  virtual ~HandleSystem() = default;
  /// Step one (section 4.1), as far as the fitting needs it.
  virtual void step_one(const Eigen::VectorXcd& q) = 0;
  /// Fitting (section 4.2.1): sets the triangles' rotations to those of step one's result.
  virtual void fit(TriangleFit& triangles) const = 0;
  /// Step two (section 4.2.2): z holds b of TriangleFit::assemble and becomes the positions v''.
  virtual void step_two(const Eigen::VectorXcd& q, Eigen::VectorXcd& z) = 0;
  /// The positions v' of the last step one.
  virtual Eigen::VectorXcd intermediate() const = 0;
};

/// For few handles: Schur complements S = C G⁻¹ Cᴴ on the factors that registration made. A
/// compilation then costs one or two solves for each handle, and the fitting of an update needs no
/// positions v'.
std::unique_ptr<HandleSystem> make_schur_complement_system(const RegisteredMesh& mesh,
                                                           const MeshHandles& handles);

/// For many handles: new factors of the paper's G' and H', from which the handles are eliminated.
/// Throws InputError where they are singular.
std::unique_ptr<HandleSystem> make_elimination_system(const RegisteredMesh& mesh,
                                                      const MeshHandles& handles);

}  // namespace deformlab
