#include "deformers/stream_deformation.h"

#include "geometry/graph_path.h"

namespace deformlab {

StreamDeformation::StreamDeformation(const Eigen::Matrix3Xd& samples,
                                     const EmbeddedDeformationOptions& options)
    : path_{samples, Eigen::Matrix3Xd(3, 0), {}},
      neighbors_(options.graph.neighbors),
      deformation_(path_, path_graph(samples), options) {}

Eigen::Matrix3Xd StreamDeformation::deformed(const Eigen::Matrix3Xd& places) const {
  const Eigen::Matrix3Xd& g = deformation_.graph().g;
  return transfer_positions(deformation_.transformations(), g, embed(places, g, neighbors_));
}

}  // namespace deformlab
