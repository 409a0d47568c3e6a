#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "energies/term_energy.h"
#include "energies/term_options.h"
#include "tests/support/samples.h"
#include "tests/support/sparse_system.h"

// The laws that every term has to obey. Each is a function, so that a test can show that it finds a
// term which breaks the law.
namespace deformlab::test {

using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;

/// The node model of a term over a graph; void for other terms.
template <class Term>
struct ModelOf {
  using Type = void;
};
template <template <class> class Term, class Node>
struct ModelOf<Term<Node>> {
  using Type = Node;
};

/// The sum of any term, whatever its `over` takes.
template <class Term>
Terms<Term> sum_over(const Sample& sample) {
  if constexpr (HasOptions<Term>) {
    return Term::over(sample.context(), typename Term::Options{});
  } else if constexpr (requires { Term::over(sample.context()); }) {
    return Term::over(sample.context());
  } else if constexpr (requires { Term::over(sample.mesh, sample.weights); }) {
    return Term::over(sample.mesh, sample.weights);
  } else {
    return Term::over(sample.mesh, sample.points);
  }
}

/// The rest state of what the term is summed over: the nodes of a graph, or the vertices of a
/// triangulation unless the term has nodes of its own.
template <class Term>
Unknowns rest_of(const Sample& sample) {
  using Node = typename ModelOf<Term>::Type;
  if constexpr (!std::is_void_v<Node>) {
    return sample.rest<Node>();
  } else if constexpr (requires { Term::rest(sample.mesh); }) {
    return Term::rest(sample.mesh);
  } else {
    return Unknowns::uniform(sample.mesh.V, static_cast<int>(sample.mesh.V.cols()));
  }
}

/// States near rest and far from it.
std::vector<Unknowns> states(const Unknowns& rest);
std::vector<Unknowns> states(const Sample& sample);

std::vector<const double*> pointers(const Energy& energy, const Unknowns& x, int e);

/// All residuals and all Jacobians. An entry that the term does not write stays NaN.
Eigen::VectorXd residuals(const Energy& energy, const Unknowns& x);
Eigen::MatrixXd jacobians(const Energy& energy, const Unknowns& x);

/// The Jacobian of one element by central differences.
Eigen::MatrixXd differences(const Energy& energy, const Unknowns& x, int e);

/// The derivatives of one element by automatic differentiation.
using Jets = std::function<void(int e, const double* const* nodes, Eigen::MatrixXd& J)>;

/// Automatic differentiation, the term's own derivative if it has one, and differences agree.
AssertionResult derivatives_agree(const Energy& energy, const Unknowns& x, const Jets& jets);
template <class Term>
AssertionResult derivatives_agree(Terms<Term> sum, const Unknowns& x) {
  std::fill(sum.weights.begin(), sum.weights.end(), 1);  // which jets() does not apply
  const TermEnergy<Term> energy(std::move(sum));
  return derivatives_agree(energy, x, [&](int e, const double* const* nodes, Eigen::MatrixXd& J) {
    energy.jets(e, nodes, J);
  });
}

AssertionResult zero_at_rest(const Energy& energy, const Unknowns& rest);

/// x after a rigid motion p → Q p + c of all space. The nodes of x are vertices (one column), rigid
/// nodes (two columns), or affine ones.
Unknowns moved(Unknowns x, const Eigen::Matrix3Xd& nodes, const Eigen::MatrixXd& Q,
               const Eigen::VectorXd& c);

AssertionResult rigidly_invariant(const Energy& energy, const Sample& sample, const Unknowns& x);

/// Whether J = aᵀ ⊗ I_d in every block.
bool is_kronecker(const Energy& energy, const Eigen::MatrixXd& J);

/// r = X a − b with the a and b that a Kronecker term gives.
AssertionResult has_its_coefficients(const Energy& energy, const Unknowns& x);

/// The declared structure is that of two states, and no stronger one could be declared.
AssertionResult has_declared_structure(const Energy& energy, const Unknowns& x, const Unknowns& y);

template <class Term>
Terms<Term> shuffled(const Terms<Term>& sum) {
  std::vector<int> order(sum.elements.size());
  for (int i = 0; i < std::ssize(order); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937_64(5));
  const int arity = static_cast<int>(sum.nodes.size() / sum.elements.size());
  Terms<Term> result{.arity = sum.arity};
  for (const int e : order) {
    result.add(sum.elements[e], std::span(sum.nodes).subspan(std::size_t(e) * arity, arity),
               sum.weights[e]);
  }
  return result;
}

/// Two orders of the same elements have the same E, JᵀJ and Jᵀr.
AssertionResult agree(const Energy& one, const Energy& other, const Unknowns& x);
template <class Term>
AssertionResult order_does_not_matter(const Terms<Term>& sum, const Unknowns& x) {
  return agree(TermEnergy<Term>(sum), TermEnergy<Term>(shuffled(sum)), x);
}

/// Every entry is written, and with a finite number.
AssertionResult all_written_and_finite(const Energy& energy, const Unknowns& x);

/// An element of weight α has residuals √α times those of weight 1, and so has its Jacobian.
AssertionResult scales(const Energy& plain, const Energy& weighted,
                       const std::vector<double>& weights, const Unknowns& x);
template <class Term>
AssertionResult weights_scale(Terms<Term> sum, const Unknowns& x) {
  std::fill(sum.weights.begin(), sum.weights.end(), 1);
  const TermEnergy<Term> plain(sum);
  for (int e = 0; e < std::ssize(sum.weights); ++e) sum.weights[e] = 0.25 * (1 + e % 7);
  return scales(plain, TermEnergy<Term>(sum), sum.weights, x);
}

AssertionResult is_lower_snake_case(std::string_view name);

}  // namespace deformlab::test
