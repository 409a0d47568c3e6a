#include "tests/energies/laws_suite.h"

namespace deformlab::test {
namespace {

INSTANTIATE_TYPED_TEST_SUITE_P(InSpace, Laws, OverNodes<AffineNode<3>>, TermNames);
INSTANTIATE_TYPED_TEST_SUITE_P(InThePlane, Laws, OverNodes<AffineNode<2>>, TermNames);
INSTANTIATE_TYPED_TEST_SUITE_P(OfRigidNodes, Laws, OverNodes<RigidNode>, TermNames);
INSTANTIATE_TYPED_TEST_SUITE_P(OverTriangles, Laws, MembersOf<TriangleTerms>::Types, TermNames);

// Each of these terms breaks one law, which the law has to find.
template <Structure structure>
struct Squared {  // r = c1 + c2 ∘ c2
  static constexpr std::string_view kName = "squared";
  static constexpr Structure kStructure = structure;
  template <class T>
  Vector<T, 3> operator()(const Matrix<T, 3>& R) const {
    return R.col(0) + R.col(1).cwiseProduct(R.col(1));
  }
};

template <Structure structure>
struct Mixed {  // r = (c1.y, c1.z, c1.x): affine, but not the same for every coordinate
  static constexpr std::string_view kName = "mixed";
  static constexpr Structure kStructure = structure;
  template <class T>
  Vector<T, 3> operator()(const Matrix<T, 3>& R) const {
    return {R(1, 0), R(2, 0), R(0, 0)};
  }
};

template <Structure structure>
struct Sum {  // r = c1 + c2: Kronecker
  static constexpr std::string_view kName = "sum";
  static constexpr Structure kStructure = structure;
  template <class T>
  Vector<T, 3> operator()(const Matrix<T, 3>& R) const {
    return R.col(0) + R.col(1);
  }
};

struct WrongJacobian {
  static constexpr std::string_view kName = "wrong_jacobian";
  static constexpr Structure kStructure = Structure::kNonlinear;
  template <class T>
  Eigen::Matrix<T, 1, 1> operator()(const Matrix<T, 3>& R) const {
    return Eigen::Matrix<T, 1, 1>(R.col(0).squaredNorm());
  }
  Eigen::Matrix<double, 1, 9> jacobian(const Eigen::Matrix3d& R) const {
    Eigen::Matrix<double, 1, 9> J = Eigen::Matrix<double, 1, 9>::Zero();
    J.head<3>() = R.col(0).transpose();  // the factor 2 is missing
    return J;
  }
};

template <int sign>
struct WithOffset {
  static constexpr std::string_view kName = "with_offset";
  static constexpr Structure kStructure = Structure::kKronecker;
  template <class T>
  Vector<T, 3> operator()(const Vector<T, 3>& v) const {
    return v - Vector<T, 3>(T(1), T(2), T(3));
  }
  Eigen::Matrix<double, 1, 1> coefficients(int) const { return Eigen::Matrix<double, 1, 1>(1.0); }
  Eigen::Vector3d offset(int) const { return {sign * 1, sign * 2, sign * 3}; }
};

struct ForgetsARow {
  static constexpr std::string_view kName = "forgets_a_row";
  static constexpr Structure kStructure = Structure::kKronecker;
  template <class T>
  Vector<T, 3> operator()(const Matrix<T, 3>& R) const {
    return {R(0, 0), R(1, 0), T(NAN)};
  }
};

template <class Term>
Terms<Term> at_every_node(const Sample& sample) {
  Terms<Term> sum;
  for (int j = 0; j < sample.nodes(); ++j) sum.add({}, {j});
  return sum;
}

template <class Term>
AssertionResult structure_of(const Sample& sample) {
  const auto x = states(sample);
  return has_declared_structure(TermEnergy<Term>(at_every_node<Term>(sample)), x[1], x[2]);
}

const Sample& sample() {
  static const Sample result = random_sample(8);
  return result;
}

TEST(LawsBite, OnAFalseStructure) {
  EXPECT_FALSE(structure_of<Squared<Structure::kKronecker>>(sample()));
  EXPECT_FALSE(structure_of<Squared<Structure::kLinear>>(sample()));
  EXPECT_TRUE(structure_of<Squared<Structure::kNonlinear>>(sample()));
  EXPECT_FALSE(structure_of<Mixed<Structure::kKronecker>>(sample()));
  EXPECT_TRUE(structure_of<Mixed<Structure::kLinear>>(sample()));
  EXPECT_TRUE(structure_of<Sum<Structure::kKronecker>>(sample()));
}

TEST(LawsBite, OnAStructureWeakerThanItCouldBe) {
  EXPECT_FALSE(structure_of<Sum<Structure::kLinear>>(sample()));
  EXPECT_FALSE(structure_of<Sum<Structure::kNonlinear>>(sample()));
  EXPECT_FALSE(structure_of<Mixed<Structure::kNonlinear>>(sample()));
}

TEST(LawsBite, OnAWrongDerivative) {
  using Right = Squared<Structure::kNonlinear>;
  const Unknowns x = states(sample())[1];
  EXPECT_FALSE(derivatives_agree(at_every_node<WrongJacobian>(sample()), x));
  EXPECT_TRUE(derivatives_agree(at_every_node<Right>(sample()), x));
}

TEST(LawsBite, OnAWrongOffset) {
  EXPECT_TRUE(structure_of<WithOffset<1>>(sample()));
  EXPECT_FALSE(structure_of<WithOffset<-1>>(sample()));
}

TEST(LawsBite, OnATermThatIsNotZeroAtRest) {
  using Term = Sum<Structure::kKronecker>;
  EXPECT_FALSE(zero_at_rest(TermEnergy<Term>(at_every_node<Term>(sample())), sample().rest()));
}

TEST(LawsBite, OnATermThatARigidMotionChanges) {
  using Term = Squared<Structure::kNonlinear>;
  const TermEnergy<Term> energy(at_every_node<Term>(sample()));
  EXPECT_FALSE(rigidly_invariant(energy, sample(), states(sample())[1]));
}

TEST(LawsBite, OnAResidualThatIsNotWritten) {
  const TermEnergy<ForgetsARow> energy(at_every_node<ForgetsARow>(sample()));
  EXPECT_FALSE(all_written_and_finite(energy, sample().rest()));
}

TEST(LawsBite, OnNames) {
  EXPECT_TRUE(is_lower_snake_case("rotation_2d"));
  for (const char* name : {"", "Rotation", "2d", "as rigid", "rotation_", "as-rigid"}) {
    EXPECT_FALSE(is_lower_snake_case(name));
  }
}

}  // namespace
}  // namespace deformlab::test
