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

/// The two linear systems of the paper for the handles of a connected mesh. Targets q (one for each
/// handle) and positions (in the registered mesh's order) are complex numbers. An update allocates
/// no memory.
class HandleSystem {
 public:
  virtual ~HandleSystem() = default;
  /// Compilation. The handles impose two conditions or more.
  virtual void compile(const MeshHandles& handles) = 0;
  /// Step one (section 4.1), which needs distinct handles: returns the positions v'.
  virtual const Eigen::VectorXcd& step_one(const Eigen::VectorXcd& q) = 0;
  /// Step two (section 4.2.2): z is b of TriangleFit::assemble and becomes the positions v''.
  virtual void step_two(const Eigen::VectorXcd& q, Eigen::VectorXcd& z) = 0;
  /// The positions v' of the last step one.
  virtual const Eigen::VectorXcd& intermediate() const = 0;
};

/// Makes a system that keeps the factors of the registration and borders them with Schur
/// complements. A compilation costs one or two solves for each handle that is new, and none for a
/// handle that is removed. Its result depends on the handles only, not on those before.
std::unique_ptr<HandleSystem> make_schur_complement_system(const RegisteredMesh& mesh);

/// Makes a system for very many handles. It factorizes the paper's G' and H', from which the
/// handles are eliminated, in every compilation. Throws InputError where they are singular.
std::unique_ptr<HandleSystem> make_elimination_system(const RegisteredMesh& mesh);

}  // namespace deformlab
