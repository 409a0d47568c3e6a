#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>

#include "deformers/embedded/embedded_deformation.h"
#include "energies/graph/sums.h"
#include "energies/register_energy.h"
#include "geometry/core/error.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

// Terms that a program adds without a change of the library.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

// A closed ball of radius 2, as rings of 12 vertices between two poles.
Shape ball() {
  constexpr int kRings = 7, kSectors = 12, kNorth = kRings * kSectors;
  Shape shape;
  shape.V.resize(3, kNorth + 2);
  shape.V.rightCols<2>() << 0, 0, 0, 0, 2, -2;
  for (int i = 0; i < kNorth; ++i) {
    const int ring = i / kSectors, sector = i % kSectors;
    const double z = std::numbers::pi * (ring + 1) / (kRings + 1);
    const double angle = 2 * std::numbers::pi * sector / kSectors;
    shape.V.col(i) << std::sin(z) * std::cos(angle), std::sin(z) * std::sin(angle), std::cos(z);
    shape.V.col(i) *= 2;
  }
  for (int s = 0; s < kSectors; ++s) {
    const int next = (s + 1) % kSectors, last = kNorth - kSectors;
    shape.faces.push_back({kNorth, s, next});
    for (int i = s, k = next; i < last; i += kSectors, k += kSectors) {
      shape.faces.push_back({i, i + kSectors, k + kSectors, k});
    }
    shape.faces.push_back({last + s, kNorth + 1, last + next});
  }
  return shape;
}

template <class T>
T volume(const std::vector<Vector<T, 3>>& v, const Eigen::Matrix3Xi& F) {
  T sum(0);
  for (const auto f : F.colwise()) sum += v[f[0]].dot(v[f[1]].cross(v[f[2]])) / 6.0;
  return sum;
}

double volume(const Shape& shape) {
  std::vector<Eigen::Vector3d> v;
  for (const auto p : shape.V.colwise()) v.push_back(p);
  return volume(v, triangles(shape));
}

/// The volume that the deformed shape encloses is a share of that at rest: one element, which reads
/// all nodes and measures the shape.
template <class Node = AffineNode<3>>
struct EnclosedVolume {
  static constexpr std::string_view kName = "enclosed_volume";
  static constexpr int d = Node::kDimension;
  struct Options {
    double share = 1;
    template <class Self, class Visit>
    static void fields(Self& o, Visit&& visit) {
      visit("share", o.share, "of the volume at rest");
    }
  };

  Eigen::Matrix3Xd V, g;  // in the problem's unit
  Embedding embedding;
  Eigen::Matrix3Xi F;
  double rest, share;

  template <class T>
  Vector<T, 1> operator()(NodeList<State<Node, T>> nodes) const {
    std::vector<Vector<T, d>> v(V.cols(), Vector<T, d>::Zero());
    std::vector<State<Node, T>> X;
    for (int j = 0; j < nodes.size(); ++j) X.push_back(nodes[j]);
    for (Eigen::Index i = 0; i < V.cols(); ++i) {
      for (Eigen::Index a = 0; a < embedding.nodes.rows(); ++a) {
        const int j = embedding.nodes(a, i);
        const Vector<double, d> arm = (V.col(i) - g.col(j)).template head<d>();
        const Vector<double, d> g_j = g.col(j).template head<d>();
        v[i] += embedding.weights(a, i) * (X[j].rotated(arm) + g_j + X[j].t);
      }
    }
    if constexpr (d == 3) return Vector<T, 1>(volume(v, F) / rest - T(share));
    return Vector<T, 1>::Zero();  // a flat shape encloses none
  }

  static Terms<EnclosedVolume> over(const GraphContext& c, const Options& options) {
    const double rest = volume(c.shape) / std::pow(c.unit, 3);
    const Eigen::Matrix3Xd V = c.shape.V / c.unit;
    std::vector<int> all(c.graph.g.cols());
    std::iota(all.begin(), all.end(), 0);
    Terms<EnclosedVolume> sum;
    sum.add({V, c.graph.g, c.vertices, triangles(c.shape), rest, options.share}, all);
    return sum;
  }
};

EmbeddedDeformationOptions twenty_nodes(SolverMethod method = SolverMethod::kGaussNewton) {
  EmbeddedDeformationOptions options;
  options.graph.nodes = 20;  // more than the usual nodes of one element
  options.solver = {.method = method, .epsilon = 1e-12, .max_iterations = 300};
  return options;
}

// Lifts the north pole a little while the south pole stays.
Report deform(EmbeddedDeformation& deformer, const Shape& shape) {
  const int n = static_cast<int>(shape.V.cols());
  deformer.compile({.fixed = {n - 1}, .moved = {n - 2}});
  return deformer.update(shape.V.col(n - 2) + Eigen::Vector3d(0, 0, 0.2));
}

TEST(OwnTerm, ThatIsRegisteredHasAWeightAndOptionsAndGoesThroughBothSolvers) {
  register_energy<EnclosedVolume>();
  const Shape shape = ball();
  for (const RotationModel model : {RotationModel::kAffine, RotationModel::kRigid}) {
    double costs[2], volumes[2];
    for (int s = 0; s < 2; ++s) {
      EmbeddedDeformationOptions options =
          twenty_nodes(s == 0 ? SolverMethod::kGaussNewton : SolverMethod::kCeres);
      options.rotation_model = model;
      options.energies["enclosed_volume"] = {1e4, {{"share", 1.2}}};
      EmbeddedDeformation deformer(shape, options);
      const Report report = deform(deformer, shape);
      EXPECT_NE(report.solve.status, Status::kFailed) << report.solve.message;
      EXPECT_TRUE(report.solve.cost_by_term.contains("enclosed_volume"));
      costs[s] = report.solve.final_cost;
      volumes[s] = volume(deformer.deformed()) / volume(shape);
    }
    EXPECT_NEAR(volumes[0], 1.2, 0.02) << name_of(model);
    EXPECT_NEAR(volumes[1], 1.2, 0.02) << name_of(model);
    EXPECT_NEAR(costs[0], costs[1], 1e-6 * costs[0]) << name_of(model);
  }
}

TEST(OwnTerm, MayBelongToOneDeformerAlone) {
  const Shape shape = ball();
  EmbeddedDeformationOptions options = twenty_nodes();
  options.extra_terms.push_back(
      {[](const GraphContext& c) { return to_energy(EnclosedVolume<>::over(c, {.share = 0.8})); },
       1e4});
  EmbeddedDeformation with(shape, options), without(shape, twenty_nodes());
  deform(with, shape);
  deform(without, shape);
  EXPECT_NEAR(volume(with.deformed()) / volume(shape), 0.8, 0.02);
  EXPECT_GT(volume(without.deformed()) / volume(shape), 0.95);
}

struct FalseStructure {
  static constexpr std::string_view kName = "false_structure";
  static constexpr Structure kStructure = Structure::kKronecker;
  template <class T>
  Vector<T, 3> operator()(const Matrix<T, 3>& R) const {
    return R.col(0) + R.col(1).cwiseProduct(R.col(2));
  }
};

TEST(OwnTerm, WithAStructureThatItDoesNotHaveIsRefused) {
  for (const SolverMethod method : {SolverMethod::kGaussNewton, SolverMethod::kCeres}) {
    EmbeddedDeformationOptions options = twenty_nodes(method);
    options.extra_terms.push_back(
        {[](const GraphContext& c) { return to_energy(over_nodes<FalseStructure>(c)); }, 1});
    EXPECT_THAT(error_of([&] { const EmbeddedDeformation deformer(ball(), options); }),
                HasSubstr("'false_structure' declares its structure as Kronecker"))
        << name_of(method);
  }
}

TEST(OwnTerm, NeedsAFunctionAndAWeight) {
  EmbeddedDeformationOptions options = twenty_nodes();
  options.extra_terms.push_back({nullptr, 1});
  EXPECT_THROW(EmbeddedDeformation(ball(), options), InputError);
  options.extra_terms = {
      {[](const GraphContext& c) { return to_energy(over_nodes<FalseStructure>(c)); }, -1}};
  EXPECT_THROW(EmbeddedDeformation(ball(), options), InputError);
}

TEST(OwnTerm, ThatIsUnknownOrHasUnknownOptionsIsRefused) {
  EmbeddedDeformationOptions options = twenty_nodes();
  options.energies["orientation"] = {1, {{"most", 1.0}}};
  EXPECT_THAT(error_of([&] { const EmbeddedDeformation deformer(ball(), options); }),
              HasSubstr("energies.orientation.most; known: weight, least"));
}

}  // namespace
}  // namespace deformlab::test
