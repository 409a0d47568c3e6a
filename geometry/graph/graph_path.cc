#include "geometry/graph/graph_path.h"

namespace deformlab {

DeformationGraph path_graph(const Eigen::Matrix3Xd& samples) {
  DeformationGraph graph{samples, {}};
  for (int j = 0; j + 1 < samples.cols(); ++j) graph.edges.push_back({j, j + 1, 1});
  return graph;
}

}  // namespace deformlab
