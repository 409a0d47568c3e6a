#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "deformers/embedded/animated_deformation.h"
#include "deformers/embedded/embedded_deformation.h"
#include "deformers/embedded/stream_deformation.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

// What a caller of the library may get wrong is refused, and never read or written out of bounds.
namespace deformlab::test {
namespace {

using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

EmbeddedDeformationOptions with_nodes(int nodes) {
  EmbeddedDeformationOptions options;
  options.graph.nodes = nodes;
  return options;
}

TEST(Misuse, OfAGraphThatIsGiven) {
  const Shape shape = bumpy_plane(10);
  const DeformationGraph good = EmbeddedDeformation(shape, with_nodes(12)).graph();
  DeformationGraph bad = good;
  bad.edges.push_back({3, 12, 1});
  EXPECT_THAT(error_of([&] { EmbeddedDeformation deformer(shape, bad, {}); }),
              HasSubstr("the nodes 3 and 12"));
  bad = good;
  bad.g(2, 5) = kNaN;
  EXPECT_THAT(error_of([&] { EmbeddedDeformation deformer(shape, bad, {}); }), HasSubstr("node 5"));
  EXPECT_THAT(error_of([&] { EmbeddedDeformation deformer(shape, bad.g, {}); }),
              HasSubstr("vertex 5"));
}

TEST(Misuse, OfTransformationsToBeginAt) {
  const Shape shape = bumpy_plane(10);
  for (const bool rigid : {false, true}) {
    EmbeddedDeformationOptions options = with_nodes(12);
    if (rigid) options.rotation_model = RotationModel::kRigid;
    EmbeddedDeformation deformer(shape, options);
    Transformations X = deformer.transformations();
    X(1, 9) = kNaN;
    EXPECT_THAT(error_of([&] { deformer.begin_at(X); }), HasSubstr("node 2"));
    X(1, 9) = -HUGE_VAL;
    EXPECT_THAT(error_of([&] { deformer.begin_at(X); }), HasSubstr("node 2"));
    EXPECT_EQ(deformer.deformed().V, shape.V);
  }
}

TEST(Misuse, OfFramesOfAnAnimation) {
  const Shape pose = bumpy_plane(10);
  AnimatedDeformation animation(pose, with_nodes(12));
  animation.compile({{0}, {99}});
  const Eigen::Vector3d offset(0, 0, 0.1);
  EXPECT_THAT(error_of([&] { animation.update(bumpy_plane(5), offset); }),
              HasSubstr("25 vertices"));
  Shape frame = pose;
  frame.V(0, 50) = kNaN;
  EXPECT_THAT(error_of([&] { animation.update(frame, offset); }), HasSubstr("vertex 50"));
  frame = pose;
  frame.N.conservativeResize(3, 7);
  EXPECT_THAT(error_of([&] { animation.update(frame, offset); }), HasSubstr("7 normals"));
  EXPECT_EQ(error_of([&] { animation.update(pose, offset); }), "");
}

TEST(Misuse, OfParticles) {
  StreamDeformation stream(bumpy_plane(4).V, {});
  EXPECT_THAT(error_of([&] { stream.deformed(Eigen::Vector3d(0, kNaN, 0)); }),
              HasSubstr("not finite"));
  EXPECT_THAT(error_of([] { StreamDeformation none(Eigen::Matrix3Xd(3, 0), {}); }),
              HasSubstr("no vertices"));
}

}  // namespace
}  // namespace deformlab::test
