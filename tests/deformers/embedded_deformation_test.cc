#include "deformers/embedded/embedded_deformation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>

#include "deformers/embedded/presets.h"
#include "geometry/graph/placement/sampling.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

EmbeddedDeformationOptions with_nodes(int nodes) {
  EmbeddedDeformationOptions options;
  options.graph.nodes = nodes;
  return options;
}

/// The vertices whose x lies in the given share of the shape's extent.
std::vector<int> strip(const Shape& shape, double from, double to) {
  const double low = shape.V.row(0).minCoeff(), high = shape.V.row(0).maxCoeff();
  std::vector<int> result;
  for (int i = 0; i < shape.V.cols(); ++i) {
    const double along = (shape.V(0, i) - low) / (high - low);
    if (along >= from && along <= to) result.push_back(i);
  }
  return result;
}

Eigen::Matrix3Xd at(const Shape& shape, const std::vector<int>& vertices) {
  return shape.V(Eigen::all, vertices);
}

/// Both ends of a shape held; the right one is lifted by `lift` [length].
struct Bend {
  Shape shape;
  Handles handles;
  Eigen::Matrix3Xd targets;

  Bend(const Shape& s, double lift) : shape(s) {
    handles.fixed = strip(shape, 0, 0.1);
    handles.moved = strip(shape, 0.9, 1);
    targets = at(shape, handles.moved).colwise() + Eigen::Vector3d(0, 0, lift);
  }
};

Eigen::Matrix3d some_rotation() {
  return Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, -2, 0.5).normalized()).matrix();
}

double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

TEST(EmbeddedDeformation, RestStaysRest) {
  const Bend bend(bumpy_plane(25), 0);
  EmbeddedDeformation deformer(bend.shape, with_nodes(40));
  EXPECT_EQ(deformer.deformed().V, bend.shape.V);
  deformer.compile(bend.handles);
  const Report report = deformer.update(bend.targets);
  EXPECT_EQ(report.solve.status, Status::kConverged);
  EXPECT_LT(report.solve.final_cost, 1e-20);
  EXPECT_LT(report.handle_rms, 1e-12);
  EXPECT_NEAR(report.min_det_R, 1, 1e-12);
  EXPECT_LT(difference(deformer.deformed().V, bend.shape.V), 1e-12);
  EXPECT_LT(difference(deformer.deformed().N, bend.shape.N), 1e-12);
}

TEST(EmbeddedDeformation, ReproducesARigidMotionOfTheHandles) {
  const Shape shape = tube(20);
  for (const SolverMethod method : {SolverMethod::kGaussNewton, SolverMethod::kCeres}) {
    EmbeddedDeformationOptions options = with_nodes(30);
    options.solver = {.method = method, .epsilon = 1e-15};
    EmbeddedDeformation deformer(shape, options);
    Handles handles;
    for (int i = 0; i < shape.V.cols(); i += 3) handles.moved.push_back(i);
    deformer.compile(handles);
    const Eigen::Matrix3d Q = some_rotation();
    const Eigen::Vector3d c(2, -1, 3);
    const Eigen::Matrix3Xd V = (Q * shape.V).colwise() + c;
    const Report report = deformer.update(V(Eigen::all, handles.moved));
    EXPECT_LT(report.solve.final_cost, 1e-12) << method;
    EXPECT_NEAR(report.min_det_R, 1, 1e-6) << method;
    EXPECT_LT(report.handle_max, 1e-6) << method;
    EXPECT_LT(difference(deformer.deformed().V, V), 1e-6) << method;
    EXPECT_LT(difference(deformer.deformed().N, Q * shape.N), 1e-6) << method;
  }
}

/// The bend done with the plane `scale` times as large, seen at the plane's own size.
Eigen::Matrix3Xd bent_at_scale(double scale, const std::string& length_unit) {
  Bend bend(bumpy_plane(25), 0.4);
  const Eigen::Matrix3Xd nodes = sample_nodes(bend.shape, 40, 1);
  bend.shape.V *= scale;
  EmbeddedDeformationOptions options;
  options.length_unit = length_unit;
  options.solver.epsilon = 1e-10;
  EmbeddedDeformation deformer(bend.shape, scale * nodes, options);
  deformer.compile(bend.handles);
  deformer.update(scale * bend.targets);
  return deformer.deformed().V / scale;
}

TEST(EmbeddedDeformation, DoesNotDependOnTheUnitOfLength) {
  const Eigen::Matrix3Xd in_m = bent_at_scale(1, "mean_edge");
  EXPECT_LT(difference(bent_at_scale(1000, "mean_edge"), in_m), 1e-9);
  EXPECT_LT(difference(bent_at_scale(0.001, "mean_edge"), in_m), 1e-9);
}

TEST(EmbeddedDeformation, DependsOnItWhereTheFormulaIsTakenAsPrinted) {
  EXPECT_GT(difference(bent_at_scale(10, "1"), bent_at_scale(1, "1")), 1e-3);
  EXPECT_LT(difference(bent_at_scale(10, "10"), bent_at_scale(1, "1")), 1e-9);
}

TEST(EmbeddedDeformation, DoesNotDependOnThePlace) {
  const Bend bend(bumpy_plane(25), 0.3);
  const Eigen::Matrix3Xd nodes = sample_nodes(bend.shape, 40, 1);
  const Eigen::Vector3d away(5, -3, 8);
  Shape there = bend.shape;
  there.V.colwise() += away;
  EmbeddedDeformation a(bend.shape, nodes, {}), b(there, nodes.colwise() + away, {});
  a.compile(bend.handles);
  b.compile(bend.handles);
  a.update(bend.targets);
  b.update(bend.targets.colwise() + away);
  EXPECT_LT(difference(a.deformed().V.colwise() + away, b.deformed().V), 1e-9);
}

TEST(EmbeddedDeformation, DoesNotDependOnTheOrderOfTheVertices) {
  const Bend bend(bumpy_plane(25), 0.3);
  const Eigen::Matrix3Xd nodes = sample_nodes(bend.shape, 40, 1);
  const int n = static_cast<int>(bend.shape.V.cols());
  Shape renumbered{Eigen::Matrix3Xd(3, n), Eigen::Matrix3Xd(3, 0), {}};
  const auto place = [n](int i) { return (7 * i + 5) % n; };  // 7 does not divide 25²
  for (int i = 0; i < n; ++i) renumbered.V.col(place(i)) = bend.shape.V.col(i);
  Handles handles = bend.handles;
  for (auto* list : {&handles.fixed, &handles.moved}) {
    for (int& i : *list) i = place(i);
  }
  EmbeddedDeformation a(bend.shape, nodes, {}), b(renumbered, nodes, {});
  a.compile(bend.handles);
  b.compile(handles);
  a.update(bend.targets);
  b.update(bend.targets);
  for (int i = 0; i < n; ++i) {
    EXPECT_LT((a.deformed().V.col(i) - b.deformed().V.col(place(i))).norm(), 1e-9);
  }
}

TEST(EmbeddedDeformation, ContinuesFromTheLastState) {
  const Bend bend(bumpy_plane(25), 0.4);
  EmbeddedDeformation deformer(bend.shape, with_nodes(40));
  deformer.compile(bend.handles);
  const Report first = deformer.update(bend.targets);
  const Eigen::Matrix3Xd V = deformer.deformed().V;
  const Report second = deformer.update(bend.targets);
  EXPECT_GT(first.solve.iterations.size(), 2u);
  EXPECT_LE(second.solve.iterations.size(), 2u);
  EXPECT_LE(second.solve.final_cost, first.solve.final_cost * (1 + 1e-9));
  deformer.reset();
  EXPECT_EQ(deformer.deformed().V, bend.shape.V);
  const Report again = deformer.update(bend.targets);
  EXPECT_EQ(again.solve.iterations.size(), first.solve.iterations.size());
  EXPECT_EQ(deformer.deformed().V, V);
}

TEST(EmbeddedDeformation, FixedVerticesDoNotMove) {
  const Bend bend(bumpy_plane(25), 0.4);
  EmbeddedDeformation deformer(bend.shape, with_nodes(60));
  deformer.compile(bend.handles);
  deformer.update(bend.targets);
  const auto& fixed = bend.handles.fixed;
  EXPECT_LT(difference(at(deformer.deformed(), fixed), at(bend.shape, fixed)), 1e-15);
  EXPECT_LT(difference(deformer.deformed().N(Eigen::all, fixed), bend.shape.N(Eigen::all, fixed)),
            1e-15);
  EXPECT_GT(difference(deformer.deformed().V, bend.shape.V), 0.3);
}

TEST(EmbeddedDeformation, FixingAVertexAgainBringsItBackToRest) {
  const Bend bend(bumpy_plane(25), 0.4);
  EmbeddedDeformation deformer(bend.shape, with_nodes(60));
  deformer.compile(bend.handles);
  deformer.update(bend.targets);
  deformer.compile({bend.handles.moved, bend.handles.fixed});
  deformer.update(at(bend.shape, bend.handles.fixed));
  EXPECT_LT(
      difference(at(deformer.deformed(), bend.handles.moved), at(bend.shape, bend.handles.moved)),
      1e-15);
}

TEST(EmbeddedDeformation, HoldsAComponentWithoutHandles) {
  const Shape one = bumpy_plane(15);
  const Shape two = side_by_side(one, one, {0, 50, 0});
  EmbeddedDeformation deformer(two, with_nodes(60));
  Bend bend(one, 0.3);
  deformer.compile(bend.handles);
  const Report report = deformer.update(bend.targets);
  EXPECT_THAT(report.notes, Contains(HasSubstr("has no handle: it stays where it is")));
  const Eigen::Index n = one.V.cols();
  EXPECT_LT(difference(deformer.deformed().V.rightCols(n), two.V.rightCols(n)), 1e-14 * 50);
  EXPECT_GT(difference(deformer.deformed().V.leftCols(n), two.V.leftCols(n)), 0.2);
}

TEST(EmbeddedDeformation, WithoutAnyHandleNothingMoves) {
  const Shape shape = bumpy_plane(15);
  EmbeddedDeformation deformer(shape, with_nodes(20));
  const Report report = deformer.update(Eigen::Matrix3Xd(3, 0));
  EXPECT_EQ(report.solve.status, Status::kConverged);
  EXPECT_THAT(report.notes, Contains(HasSubstr("has no handle")));
  EXPECT_LT(difference(deformer.deformed().V, shape.V), 1e-15);
}

TEST(EmbeddedDeformation, ASingleHandleTranslatesTheShape) {
  const Shape shape = bumpy_plane(15);
  const Eigen::Vector3d target = shape.V.col(112) + Eigen::Vector3d(0.3, -0.2, 1);
  for (const SolverMethod method : {SolverMethod::kGaussNewton, SolverMethod::kCeres}) {
    EmbeddedDeformationOptions options = with_nodes(20);
    options.solver = {.method = method, .epsilon = 1e-12};
    EmbeddedDeformation deformer(shape, options);
    deformer.compile({{}, {112}});
    const Report report = deformer.update(target);
    EXPECT_EQ(report.solve.status, Status::kConverged) << method;
    EXPECT_THAT(report.notes, Contains(HasSubstr("is pinned at one point only")));
    const Eigen::Matrix3Xd& V = deformer.deformed().V;
    EXPECT_LT((V.col(112) - target).norm(), 1e-6) << method;
    EXPECT_LT(difference(V.colwise() - target, shape.V.colwise() - shape.V.col(112)), 1e-6)
        << method;
    EXPECT_NEAR(report.min_det_R, 1, 1e-6) << method;
  }
}

TEST(EmbeddedDeformation, HandlesOnALineAreNoted) {
  const Shape shape = bumpy_plane(15, 1, 0);
  EmbeddedDeformation deformer(shape, with_nodes(20));
  deformer.compile({{}, {0, 5, 14}});
  const Report report = deformer.update(at(shape, {0, 5, 14}));
  EXPECT_THAT(report.notes, Contains(HasSubstr("is pinned on one line only")));
}

TEST(EmbeddedDeformation, HandlesThatCannotMoveAreNoted) {
  const Shape shape = bumpy_plane(15);
  EmbeddedDeformation deformer(shape, with_nodes(20));
  Handles handles{{}, {112}};
  for (int i = 0; i < 225; ++i) {
    if (i != 112) handles.fixed.push_back(i);
  }
  deformer.compile(handles);
  const Report report = deformer.update(shape.V.col(112) + Eigen::Vector3d(0, 0, 1));
  EXPECT_THAT(report.notes,
              Contains(HasSubstr("handles that follow fixed nodes only and so cannot move: 1")));
  EXPECT_NEAR(report.handle_rms, 1, 1e-12);
}

TEST(EmbeddedDeformation, ReportsWhatItMeasures) {
  const Bend bend(bumpy_plane(25), 0.15);
  EmbeddedDeformation deformer(bend.shape, with_nodes(40));
  deformer.compile(bend.handles);
  const Report report = deformer.update(bend.targets);
  const Eigen::RowVectorXd distance =
      (at(deformer.deformed(), bend.handles.moved) - bend.targets).colwise().norm();
  EXPECT_NEAR(report.handle_rms, distance.norm() / std::sqrt(distance.size()), 1e-12);
  EXPECT_NEAR(report.handle_max, distance.maxCoeff(), 1e-12);
  EXPECT_GT(report.handle_rms, 0);
  EXPECT_LT(report.handle_rms, 0.05);
  double least = INFINITY;
  const Transformations X = deformer.transformations();
  for (int j = 0; j < 40; ++j) least = std::min(least, X.middleCols<3>(4 * j).determinant());
  EXPECT_EQ(report.min_det_R, least);
  EXPECT_GT(least, 0.5);
  EXPECT_EQ(report.nodes, 40);
  EXPECT_EQ(report.edges, std::ssize(deformer.graph().edges));
  EXPECT_EQ(report.length_unit, mean_edge_length(deformer.graph()));
  EXPECT_THAT(report.notes, IsEmpty());
  for (const char* phase : {"sample", "embed", "connect", "compile", "solve", "transfer"}) {
    EXPECT_GE(report.seconds.at(phase), 0) << phase;
  }
}

TEST(EmbeddedDeformation, SeesAReflection) {
  const Shape shape = bumpy_plane(15);
  EmbeddedDeformation deformer(shape, with_nodes(20));
  Handles all;
  for (int i = 0; i < shape.V.cols(); ++i) all.moved.push_back(i);
  deformer.compile(all);
  Eigen::Matrix3Xd mirrored = shape.V;
  mirrored.row(0) *= -1;
  EXPECT_LT(deformer.update(mirrored).min_det_R, 0);
}

TEST(EmbeddedDeformation, GivesTheSameBitsTwice) {
  const Bend bend(bumpy_plane(25), 0.4);
  for (const SolverMethod method : {SolverMethod::kGaussNewton, SolverMethod::kCeres}) {
    EmbeddedDeformationOptions options = with_nodes(40);
    options.solver.method = method;
    Eigen::Matrix3Xd V[2];
    for (auto& result : V) {
      EmbeddedDeformation deformer(bend.shape, options);
      deformer.compile(bend.handles);
      deformer.update(bend.targets);
      result = deformer.deformed().V;
    }
    EXPECT_EQ(V[0], V[1]) << method;
  }
}

TEST(EmbeddedDeformation, BothSolversAgree) {
  const Bend bend(tube(20), 1);
  Eigen::Matrix3Xd V[2];
  for (const bool ceres : {false, true}) {
    EmbeddedDeformationOptions options = with_nodes(40);
    options.solver = {.method = ceres ? SolverMethod::kCeres : SolverMethod::kGaussNewton,
                      .epsilon = 1e-12};
    options.solver.globalization = "levenberg";
    EmbeddedDeformation deformer(bend.shape, options);
    deformer.compile(bend.handles);
    EXPECT_EQ(deformer.update(bend.targets).solve.status, Status::kConverged);
    V[ceres] = deformer.deformed().V;
  }
  EXPECT_LT(difference(V[0], V[1]), 1e-5);
}

// Two clusters of five nodes, over the left and the right of a plane, that no edge joins.
EmbeddedDeformationOptions in_two_parts() {
  EmbeddedDeformationOptions options;
  options.graph.method = NodePlacement::kFile;
  options.graph.file = std::filesystem::path(::testing::TempDir()) / "two_parts.obj";
  std::ofstream file(options.graph.file);
  for (const double x : {0.0, 0.55}) {
    for (const double y : {0.0, 1.0}) {
      file << "v " << x << " " << y << " 0\nv " << x + 0.4 << " " << y << " 0\n";
    }
    file << "v " << x + 0.2 << " 0.5 0\n";
  }
  file << "l 1 2 3 4 5\nl 6 7 8 9 10\n";
  return options;
}

TEST(EmbeddedDeformation, AHandleHoldsEveryPartOfTheGraphThatItFollows) {
  const Shape plane = bumpy_plane(21, 1, 0);
  EmbeddedDeformation deformer(plane, in_two_parts());
  deformer.compile({{}, {220}});  // the middle, between the clusters
  const Eigen::Vector3d t(0.3, 0.1, 2);
  const Report report = deformer.update(plane.V.col(220) + t);
  EXPECT_THAT(report.notes, Not(Contains(HasSubstr("has no handle"))));
  EXPECT_LT(difference(deformer.deformed().V, plane.V.colwise() + t), 1e-6);
}

TEST(EmbeddedDeformation, AHandleThatOnlyFixedNodesPullIsNotedBehindACut) {
  // The cut leaves one node to the left side; the others only fill up what its vertices follow.
  const Shape plane = bumpy_plane(21, 1, 0);
  const std::vector<int> left = strip(plane, 0, 0.25), right = strip(plane, 0.3, 1);
  const Eigen::Matrix3Xd nodes =
      plane.V(Eigen::all, std::vector<int>{212, 10, 20, 220, 225, 430, 440});
  EmbeddedDeformation deformer(plane, nodes, {}, std::vector<Cut>{{left, right}});
  deformer.compile({{left[0]}, {left[1], right.back()}});
  const Report report = deformer.update(at(plane, {left[1], right.back()}));
  EXPECT_THAT(report.notes, Contains(HasSubstr("so cannot move: 1;")));
}

TEST(EmbeddedDeformation, KeepsAGraphThatIsGivenWithAnyPreset) {
  const Shape shape = bumpy_plane(9);
  const Eigen::Matrix3Xd nodes = shape.V(Eigen::all, std::vector<int>{0, 8, 40, 72, 80});
  EmbeddedDeformation deformer(shape, nodes, preset_options());
  Handles handles{.fixed = {0}, .moved = {80}};
  deformer.compile(handles);
  EXPECT_EQ(deformer.graph().g, nodes);
}

TEST(EmbeddedDeformation, TimesTheCompilationThatBuildsAGraph) {
  const Shape shape = bumpy_plane(9);
  EmbeddedDeformation deformer(shape, preset_options());
  Handles handles{.fixed = {0}, .moved = {80}};
  deformer.compile(handles);
  EXPECT_TRUE(deformer.update(shape.V.col(80)).seconds.contains("compile"));
}

}  // namespace
}  // namespace deformlab::test
