#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "deformers/arap_2d/handle_points.h"
#include "deformers/arap_2d/registered_mesh.h"

namespace deformlab {

/// The two linear systems of the paper for one set of places that are held (compilation). Targets q
/// are complex, one a place; positions are in the registered mesh's order. Only `intermediate`
/// allocates.
class HandleSystem {
 public:
  virtual ~HandleSystem() = default;
  /// Section 4.1, as far as the fit needs it.
  virtual void step_one(const Eigen::VectorXcd& q) = 0;
  /// Section 4.2.1: the rotations of step one's result.
  virtual void fit(TriangleFit& triangles) const = 0;
  /// Section 4.2.2: z holds b of TriangleFit::assemble and becomes the positions v''.
  virtual void step_two(const Eigen::VectorXcd& q, Eigen::VectorXcd& z) = 0;
  /// The result of the last step one itself, the positions v'.
  virtual Eigen::VectorXcd intermediate() const = 0;
};

/// What is held of a mesh.
struct Held {
  std::vector<BarycentricPoint> places;  ///< of vertices by their place in the order
  std::vector<Cluster> clusters;         ///< of these places
  bool turns;                            ///< not all in one place: they say how the shape is turned
};

/// For few places: Schur complements S = C G⁻¹ Cᴴ on the factors that registration made, so that a
/// compilation costs a solve or two for a place, and step one nothing at all in an update.
std::unique_ptr<HandleSystem> make_few_held(const RegisteredMesh& mesh, const Held& held);

/// For many places: new factors of G' and H' without what is held, as in the paper.
std::unique_ptr<HandleSystem> make_many_held(const RegisteredMesh& mesh, const Held& held);

}  // namespace deformlab
