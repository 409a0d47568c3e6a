#pragma once

#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include "energies/energy.h"
#include "energies/signature.h"

namespace deformlab {

/// The name of a term, or an empty one if it has none, which TermEnergy refuses.
template <class Term>
constexpr std::string_view name_of() {
  if constexpr (requires { Term::kName; }) return Term::kName;
  return "";
}

/// Throw InputError because an element of a term was given another number of nodes than it reads,
/// or a weight that is negative or not a number.
[[noreturn]] void throw_wrong_nodes(std::string_view term, std::size_t element, std::size_t given,
                                    int arity);
[[noreturn]] void throw_wrong_weight(std::string_view term, std::size_t element, double weight);

/// The elements of one term and the nodes that each of them reads: the Σ of the paper.
///
/// A term is a struct that holds the data of one element. Its call operator is a template over the
/// scalar and returns the residual as a vector of fixed size (kMaxResiduals at most). The types of
/// its arguments say what the residual reads, one node for each argument:
///   const Vector<T, d>&        the first column of the node, such as a vertex
///   const Matrix<T, d>&        the first d columns, such as R_j of an affine node
///   const State<Node, T>&      a graph node of any model (energies/graph/nodes.h)
///   NodeList<State<Node, T>>   any number of nodes, the same number for each element
/// A term also needs its kName. These members are optional:
///   kStructure    what a solver may rely on; nonlinear if the term does not say
///   kWeight       its weight if a config names none; 0 if the term does not say
///   kZeroAtRest, kRigidlyInvariant   laws that hold for the term and that the tests then check
///   jacobian      the derivative; without it, the derivative is found by automatic differentiation
///   coefficients  the same for a Kronecker term: a of J = aᵀ ⊗ I_d, given the number of nodes
///   offset        b of r = X a − b, for a Kronecker term with coefficients
///   set_targets   takes the targets of the handles, d×p
/// Terms over a graph also have `over`, which makes the sum (energies/graph/sums.h), and may have
/// Options, which configs set (energies/term_options.h).
template <class Term>
struct Terms {
  int arity = SignatureOf<Term>::kArity;  ///< nodes of an element; `add` replaces 0, any number
  std::vector<Term> elements{};
  std::vector<int> nodes{};       ///< arity entries for each element
  std::vector<double> weights{};  ///< one for each element

  void reserve(std::size_t count) {
    elements.reserve(count);
    nodes.reserve(count * arity);
    weights.reserve(count);
  }

  /// Throws InputError if the number of nodes is not that of the term, or of the elements so far,
  /// and for a weight below 0.
  void add(const Term& element, std::span<const int> its_nodes, double weight = 1) {
    if (arity == 0) arity = static_cast<int>(its_nodes.size());
    if (std::ssize(its_nodes) != arity || arity == 0) {
      throw_wrong_nodes(name_of<Term>(), elements.size(), its_nodes.size(), arity);
    }
    if (!(weight >= 0)) throw_wrong_weight(name_of<Term>(), elements.size(), weight);
    elements.push_back(element);
    nodes.insert(nodes.end(), its_nodes.begin(), its_nodes.end());
    weights.push_back(weight);
  }
  void add(const Term& element, std::initializer_list<int> its_nodes, double weight = 1) {
    add(element, std::span(its_nodes.begin(), its_nodes.size()), weight);
  }
};

}  // namespace deformlab
