#include "deformers/embedded/stream_deformation.h"

#include "geometry/graph/graph_path.h"

namespace deformlab {

StreamDeformation::StreamDeformation(const Eigen::Matrix3Xd& samples,
                                     const EmbeddedDeformationOptions& options)
    : path_{samples, Eigen::Matrix3Xd(3, 0), {}},
      neighbors_(options.graph.neighbors),
      deformation_(path_, path_graph(samples), options) {}

Embedding StreamDeformation::influences(const Eigen::Matrix3Xd& positions) const {
  return embed(positions, deformation_.graph().g, neighbors_);
}

Eigen::Matrix3Xd StreamDeformation::deformed(const Embedding& particles) const {
  return transfer_positions(deformation_.transformations(), deformation_.graph().g, particles);
}

Eigen::Matrix3Xd StreamDeformation::rotations(const Eigen::Matrix3Xd& positions) const {
  const Transformations X = deformation_.transformations();
  const Embedding e = influences(positions);
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, 3 * positions.cols());
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    for (Eigen::Index a = 0; a < e.nodes.rows(); ++a) {
      result.middleCols<3>(3 * i) += e.weights(a, i) * X.middleCols<3>(4 * e.nodes(a, i));
    }
  }
  return result;
}

}  // namespace deformlab
