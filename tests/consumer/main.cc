#include <cstdio>
#include <cstdlib>

#include "deformers/embedded/embedded_deformation.h"

// Bends a bar of points: enough to call every library that deformlab needs behind it.
int main() {
  deformlab::Shape bar;
  bar.V.resize(3, 300);
  for (int i = 0; i < 300; ++i) bar.V.col(i) << 0.1 * (i / 4), 0.1 * (i % 2), 0.1 * (i / 2 % 2);
  deformlab::EmbeddedDeformationOptions options;
  options.graph.nodes = 30;
  deformlab::EmbeddedDeformation deformer(bar, options);
  deformer.compile({.fixed = {0, 1, 2, 3}, .moved = {299}});
  const Eigen::Vector3d target = bar.V.col(299) + Eigen::Vector3d(-0.5, 0, 2);
  deformer.update(target);
  const double distance = (deformer.deformed().V.col(299) - target).norm();
  std::printf("the handle ends %g from its target\n", distance);
  return distance < 0.1 ? EXIT_SUCCESS : EXIT_FAILURE;
}
