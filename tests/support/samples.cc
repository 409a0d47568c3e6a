#include "tests/support/samples.h"

#include <random>

#include "tests/support/shapes.h"

namespace deformlab::test {

Triangulation shaken_grid(int n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> shake(-0.2, 0.2);
  Triangulation mesh{Eigen::Matrix2Xd(2, n * n), Eigen::Matrix3Xi(3, 2 * (n - 1) * (n - 1))};
  for (int i = 0; i < n * n; ++i) {
    const int x = i % n, y = i / n;
    mesh.V.col(i) << x + shake(random), y + shake(random);
  }
  mesh.V *= 3.0 / (n - 1);
  for (int y = 0, f = 0; y + 1 < n; ++y) {
    for (int x = 0; x + 1 < n; ++x) {
      const int a = y * n + x;
      mesh.F.col(f++) << a, a + 1, a + 1 + n;
      mesh.F.col(f++) << a, a + 1 + n, a + n;
    }
  }
  return mesh;
}

Sample make_sample(const Eigen::Matrix3Xd& g, const Eigen::Matrix3Xd& v, int k) {
  const Embedding shape = embed(v, g, k);
  Sample sample;
  sample.graph = connect(g, shape, EdgeWeights::kOverlap);
  const double low = v.row(0).minCoeff(), high = v.row(0).maxCoeff();
  std::vector<int> ends;
  for (int i = 0; i < v.cols(); ++i) {
    const double along = (v(0, i) - low) / (high - low);
    if (along < 0.1 || along > 0.9) ends.push_back(i);
  }
  sample.handles = subset(shape, ends);
  const double unit = mean_edge_length(sample.graph);
  sample.graph.g /= unit;
  sample.handles.v /= unit;
  sample.vertices = shape;
  sample.vertices.v /= unit;
  sample.shape.V = sample.vertices.v;
  return sample;
}

Sample random_sample(int m, int k, unsigned seed) {
  const Eigen::Vector3d size(3, 1, 0.3);
  Sample sample =
      make_sample(random_points(m, size, seed), random_points(15 * m, size, seed + 1), k);
  sample.mesh = shaken_grid(4, seed);
  sample.weights = Eigen::VectorXd::LinSpaced(sample.mesh.F.cols(), 0.5, 3);
  for (const int f : {0, 3, 7}) sample.points.push_back({sample.mesh.F.col(f), {0.2, 0.3, 0.5}});
  return sample;
}

Eigen::Matrix3Xd twisted(const Embedding& handles, double angle, double lift) {
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).matrix();
  const double middle = (handles.v.row(0).minCoeff() + handles.v.row(0).maxCoeff()) / 2;
  Eigen::Matrix3Xd targets = handles.v;
  for (auto q : targets.colwise()) {
    if (q.x() > middle) q = Q * q + Eigen::Vector3d(0, 0, lift);
  }
  return targets;
}

Unknowns perturbed(Unknowns x, double size, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (auto& entry : x.X.reshaped()) entry += size * normal(random);
  return x;
}

}  // namespace deformlab::test
