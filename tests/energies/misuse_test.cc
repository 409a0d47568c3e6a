#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "energies/graph/rotation.h"
#include "energies/graph/sums.h"
#include "energies/register_energy.h"
#include "energies/structure.h"
#include "geometry/core/error.h"
#include "tests/energies/laws.h"

// What a term may do wrong is refused with a message that names the term.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

template <class Call>
std::string error_of(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

struct Spring {  // reads two nodes
  static constexpr std::string_view kName = "spring";
  template <class T>
  Vector<T, 1> operator()(const Vector<T, 3>& a, const Vector<T, 3>& b) const {
    return Vector<T, 1>((a - b).squaredNorm());
  }
};

struct Spread {  // reads any number of nodes
  static constexpr std::string_view kName = "spread";
  template <class T>
  Vector<T, 2> operator()(NodeList<Affine<T, 3>> nodes) const {
    Vector<T, 2> r(T(0), T(0));
    for (int j = 0; j < nodes.size(); ++j) {
      const Affine<T, 3> node = nodes[j];
      r += Vector<T, 2>(node.t.squaredNorm(), node.R.determinant());
    }
    return r;
  }
};

TEST(Misuse, ElementsHaveAsManyNodesAsTheTermReads) {
  Terms<Spring> sum;
  sum.add({}, {0, 1});
  const std::string error = error_of([&] { sum.add({}, {2}); });
  EXPECT_THAT(error, HasSubstr("element 1 of the term 'spring' was given 1 node, but"));
  EXPECT_THAT(error, HasSubstr("reads 2"));
  EXPECT_THAT(error_of([&] { sum.add({}, {0, 1, 2}); }), HasSubstr("was given 3 nodes"));
  EXPECT_EQ(sum.elements.size(), 1u);
}

TEST(Misuse, ElementsOfAnyNumberOfNodesHaveTheSameNumber) {
  Terms<Spread> sum;
  EXPECT_THAT(error_of([&] { sum.add({}, std::span<const int>()); }),
              HasSubstr("reads at least 1"));
  sum.add({}, {0, 1, 2});
  EXPECT_THAT(error_of([&] { sum.add({}, {0, 1}); }), HasSubstr("'spread' was given 2 nodes"));
}

TEST(Misuse, WeightsOfElementsAreNumbersOf0OrMore) {
  for (const double weight : {-1.0, std::nan("")}) {
    Terms<Spring> sum;
    EXPECT_THAT(error_of([&] { sum.add({}, {0, 1}, weight); }), HasSubstr("'spring'"));
  }
}

TEST(AnyNumberOfNodes, MayBeLarge) {
  const Sample sample = random_sample(40);
  Terms<Spread> sum;
  std::vector<int> all(40);
  for (int j = 0; j < 40; ++j) all[j] = j;
  sum.add({}, all);
  for (const Unknowns& x : states(sample)) {
    EXPECT_TRUE(derivatives_agree(sum, x));
    const TermEnergy<Spread> energy(sum);
    const SparseSystem system = sparse_system({{&energy}}, x);
    const int n = energy.jacobian_columns();
    Eigen::MatrixXd JtJ(n, n);
    Eigen::VectorXd Jtr(n), other(n), r = residuals(energy, x);
    energy.normal_equations(x, JtJ.data(), Jtr.data());
    energy.transposed_products(x, r.data(), other.data());
    EXPECT_LT(relative_difference(JtJ, Eigen::MatrixXd(system.JtJ())), 1e-13);
    EXPECT_LT(relative_difference(Jtr, Eigen::VectorXd(system.Jtr())), 1e-13);
    EXPECT_LT(relative_difference(other, Jtr), 1e-13);
  }
}

template <Structure structure>
struct Square {  // is neither linear nor Kronecker
  static constexpr std::string_view kName = "square";
  static constexpr Structure kStructure = structure;
  template <class T>
  Vector<T, 3> operator()(const Vector<T, 3>& v) const {
    return v.cwiseProduct(v);
  }
};

template <Structure structure>
struct Swap {  // is linear, but not Kronecker
  static constexpr std::string_view kName = "swap";
  static constexpr Structure kStructure = structure;
  template <class T>
  Vector<T, 3> operator()(const Vector<T, 3>& v) const {
    return {v[1], v[0], v[2]};
  }
};

struct WrongCoefficients {  // is Kronecker, with a = 1
  static constexpr std::string_view kName = "wrong_coefficients";
  static constexpr Structure kStructure = Structure::kKronecker;
  template <class T>
  Vector<T, 3> operator()(const Vector<T, 3>& v) const {
    return v;
  }
  Vector<double, 1> coefficients(int) const { return Vector<double, 1>(2.0); }
};

template <class Term>
std::string structure_error() {
  Terms<Term> sum;
  for (int j = 0; j < 20; ++j) sum.add({}, {j});
  return error_of([&] { check_structure(TermEnergy<Term>(sum)); });
}

TEST(Misuse, AFalseStructureIsFound) {
  using enum Structure;
  EXPECT_THAT(structure_error<Square<kLinear>>(),
              HasSubstr("'square' declares its structure as linear"));
  EXPECT_THAT(structure_error<Square<kKronecker>>(), HasSubstr("declare Structure::kNonlinear"));
  EXPECT_EQ(structure_error<Square<kNonlinear>>(), "accepted");
  EXPECT_THAT(structure_error<Swap<kKronecker>>(), HasSubstr("'swap'"));
  EXPECT_THAT(structure_error<Swap<kKronecker>>(), HasSubstr("declare Structure::kLinear"));
  EXPECT_EQ(structure_error<Swap<kLinear>>(), "accepted");
  EXPECT_THAT(structure_error<WrongCoefficients>(), HasSubstr("correct the derivative"));
}

TEST(Misuse, EveryKnownTermHasItsStructure) {
  const Sample sample = random_sample(12);
  for (const EnergyInfo& info : known_energies()) {
    for (const int d : {2, 3}) {
      EXPECT_NO_THROW(check_structure(*make_energy(info.name, sample.context(d)))) << info.name;
    }
  }
}

// A term of a program's own, with options of every type.
template <class Node = AffineNode<3>>
struct Pull {
  static constexpr std::string_view kName = "pull";
  static constexpr Structure kStructure = Structure::kKronecker;
  struct Options {
    double strength = 2;
    int first = 0;
    bool mirrored = false;
    std::string side = "left";
    std::filesystem::path file;

    template <class Self, class Visit>
    static void fields(Self& o, Visit&& visit) {
      visit("strength", o.strength, "how far");
      visit("first", o.first, "first node");
      visit("mirrored", o.mirrored, "to the other side");
      visit.choice("side", o.side, {"left", "right"}, "where to");
      visit("file", o.file, "measured data");
    }
  };
  Vector<double, Node::kDimension> q;

  template <class T>
  Vector<T, Node::kDimension> operator()(const State<Node, T>& j) const {
    return j.t - q;
  }
  static Terms<Pull> over(const GraphContext&, const Options& o) {
    Terms<Pull> sum;
    const double sign = (o.side == "left") == o.mirrored ? 1 : -1;
    sum.add({sign * o.strength * Vector<double, Node::kDimension>::Ones()}, {o.first});
    return sum;
  }
};

TEST(OwnTerm, IsRegisteredOnceWithItsOptions) {
  register_energy<Pull>();
  EXPECT_THAT(error_of([] { register_energy<Pull>(); }), HasSubstr("'pull' is registered already"));
  EXPECT_THAT(error_of([] { register_energy<Rotation>(); }), HasSubstr("'rotation'"));
  const EnergyInfo& info = energy_info("pull");
  EXPECT_TRUE(info.for_rigid_nodes);
  ASSERT_EQ(info.options.size(), 5u);
  EXPECT_EQ(info.options[0].name, "strength");
  EXPECT_EQ(std::get<double>(info.options[0].value), 2);
  EXPECT_THAT(info.options[3].allowed, ::testing::ElementsAre("left", "right"));

  const Sample sample = random_sample(12);
  const OptionValues values{{"strength", 3}, {"side", std::string("right")}, {"first", 5}};
  for (const int d : {2, 3}) {
    const auto energy = make_energy("pull", sample.context(d), values);
    EXPECT_EQ(energy->nodes(0)[0], 5);
    Eigen::VectorXd b(d);
    energy->offsets(b.data());
    EXPECT_EQ(b, Eigen::VectorXd::Constant(d, 3));
  }
}

TEST(OwnTerm, WrongOptionsAreRefused) {
  const std::string term = "pull";
  using Options = Pull<>::Options;
  const auto error = [&](const OptionValues& values) {
    return error_of([&] {
      check_option_names(term, describe_options<Options>(), values);
      make_options<Options>(term, values);
    });
  };
  EXPECT_EQ(error({{"file", std::string("data.csv")}}), "accepted");
  EXPECT_EQ(error({{"strength", 1.5}, {"mirrored", true}}), "accepted");
  EXPECT_THAT(error({{"strenght", 1.0}}),
              HasSubstr("unknown option energies.pull.strenght; known: "));
  EXPECT_THAT(error({{"first", 1.5}}),
              HasSubstr("energies.pull.first is 1.5; it has to be a whole"));
  EXPECT_THAT(error({{"side", std::string("up")}}), HasSubstr("has to be one of left, right"));
}

}  // namespace
}  // namespace deformlab::test
