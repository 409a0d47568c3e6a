#pragma once

#include <tuple>
#include <type_traits>
#include <utility>

#include "energies/all.h"
#include "energies/register_energy.h"
#include "tests/energies/laws.h"

// The laws as one suite, for any list of terms. No term is named here.
namespace deformlab::test {

/// One term, and the list that it stands in.
template <class Term_, class List>
struct Member {
  using Term = Term_;
  using Terms = List;
};

template <class List>
struct MembersOf;
template <class... Term>
struct MembersOf<TermList<Term...>> {
  using Types = ::testing::Types<Member<Term, TermList<Term...>>...>;
};

/// The terms of a list over one node model, without those that are not defined for it.
template <class Node, class List>
struct TermsOver;
template <class Node, template <class> class... Term>
struct TermsOver<Node, GraphTermList<Term...>> {
  template <class... T>
  static TermList<T...> list(const std::tuple<T...>&);
  using List = decltype(list(
      std::tuple_cat(std::declval<std::conditional_t<fits<Term<Node>, Node>(),
                                                     std::tuple<Term<Node>>, std::tuple<>>>()...)));
};

/// What a law test of all terms over one node model is instantiated with. For a term of your own,
/// instantiate the suite with OverNodes<Node, GraphTermList<YourTerm>>.
template <class Node, class List = GraphTerms>
using OverNodes = typename MembersOf<typename TermsOver<Node, List>::List>::Types;

/// Names a member's tests after its term.
struct TermNames {
  template <class T>
  static std::string GetName(int) {
    return std::string(T::Term::kName);
  }
};

template <class... Term>
std::vector<std::string_view> names(TermList<Term...>) {
  return {Term::kName...};
}

template <class T>
class Laws : public ::testing::Test {
 protected:
  const std::vector<Sample> samples_{random_sample(12, 4, 1), random_sample(9, 2, 7)};
  template <class Law>
  void everywhere(Law&& law) {
    for (const Sample& sample : samples_) {
      for (const Unknowns& x : states(rest_of<typename T::Term>(sample))) law(sample, x);
    }
  }
};
TYPED_TEST_SUITE_P(Laws);

TYPED_TEST_P(Laws, DerivativesAgree) {
  using Term = typename TypeParam::Term;
  this->everywhere([](const Sample& sample, const Unknowns& x) {
    EXPECT_TRUE(derivatives_agree(sum_over<Term>(sample), x));
  });
}

TYPED_TEST_P(Laws, HasElements) {
  using Term = typename TypeParam::Term;
  for (const Sample& sample : this->samples_) {
    const TermEnergy<Term> energy(sum_over<Term>(sample));
    EXPECT_GT(energy.size(), 0);
    EXPECT_EQ(energy.name(), Term::kName);
    EXPECT_EQ(energy.structure(), deformlab::structure_of<Term>());
  }
}

TYPED_TEST_P(Laws, ZeroAtRestWhereDeclared) {
  using Term = typename TypeParam::Term;
  if constexpr (requires { requires Term::kZeroAtRest; }) {
    for (const Sample& sample : this->samples_) {
      EXPECT_TRUE(zero_at_rest(TermEnergy<Term>(sum_over<Term>(sample)), rest_of<Term>(sample)));
    }
  }
}

TYPED_TEST_P(Laws, RigidlyInvariantWhereDeclared) {
  using Term = typename TypeParam::Term;
  if constexpr (requires { requires Term::kRigidlyInvariant; }) {
    this->everywhere([](const Sample& sample, const Unknowns& x) {
      EXPECT_TRUE(rigidly_invariant(TermEnergy<Term>(sum_over<Term>(sample)), sample, x));
    });
  }
}

TYPED_TEST_P(Laws, HasTheStructureThatItDeclares) {
  using Term = typename TypeParam::Term;
  for (const Sample& sample : this->samples_) {
    const auto x = states(rest_of<Term>(sample));
    EXPECT_TRUE(has_declared_structure(TermEnergy<Term>(sum_over<Term>(sample)), x[1], x[2]));
  }
}

TYPED_TEST_P(Laws, OrderOfElementsDoesNotMatter) {
  using Term = typename TypeParam::Term;
  this->everywhere([](const Sample& sample, const Unknowns& x) {
    EXPECT_TRUE(order_does_not_matter(sum_over<Term>(sample), x));
  });
}

TYPED_TEST_P(Laws, WritesEverythingAndStaysFinite) {
  using Term = typename TypeParam::Term;
  this->everywhere([](const Sample& sample, const Unknowns& x) {
    const TermEnergy<Term> energy(sum_over<Term>(sample));
    EXPECT_TRUE(all_written_and_finite(energy, x));
    EXPECT_TRUE(all_written_and_finite(energy, perturbed(x, 1e4)));
  });
}

TYPED_TEST_P(Laws, WeightsOfElementsScale) {
  using Term = typename TypeParam::Term;
  this->everywhere([](const Sample& sample, const Unknowns& x) {
    EXPECT_TRUE(weights_scale(sum_over<Term>(sample), x));
  });
}

TYPED_TEST_P(Laws, HasANameOfItsOwn) {
  const auto all = names(typename TypeParam::Terms{});
  EXPECT_TRUE(is_lower_snake_case(TypeParam::Term::kName));
  EXPECT_EQ(std::count(all.begin(), all.end(), TypeParam::Term::kName), 1);
}

REGISTER_TYPED_TEST_SUITE_P(Laws, DerivativesAgree, HasElements, ZeroAtRestWhereDeclared,
                            RigidlyInvariantWhereDeclared, HasTheStructureThatItDeclares,
                            OrderOfElementsDoesNotMatter, WritesEverythingAndStaysFinite,
                            WeightsOfElementsScale, HasANameOfItsOwn);

}  // namespace deformlab::test
