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

Eigen::Matrix3Xd StreamDeformation::turns(const Eigen::Matrix3Xd& places) const {
  const Transformations X = deformation_.transformations();
  const Embedding e = embed(places, deformation_.graph().g, neighbors_);
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, 3 * places.cols());
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    for (Eigen::Index a = 0; a < e.nodes.rows(); ++a) {
      result.middleCols<3>(3 * i) += e.weights(a, i) * X.middleCols<3>(4 * e.nodes(a, i));
    }
  }
  return result;
}

}  // namespace deformlab
