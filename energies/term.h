#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "energies/energy.h"
#include "geometry/graph/deformation_graph.h"

namespace deformlab {

template <class T, int d>
using Vector = Eigen::Matrix<T, d, 1>;
template <class T, int d>
using Matrix = Eigen::Matrix<T, d, d>;

/// The transformation of one graph node (Sumner et al. 2007, Eq. 1), in space (d = 3) or in the
/// plane (d = 2).
template <class T, int d>
struct Affine {
  Matrix<T, d> R;
  Vector<T, d> t;  ///< [length]
};

/// The elements of one term and the nodes that each of them reads: the Σ of the paper.
///
/// A term is a struct of one element's data with a call operator, a template over the scalar, that
/// returns the residual as a vector of fixed size (kMaxResiduals at most). What the operator takes
/// says what it reads:
///   const Affine<T, d>&              all of a graph node
///   const Matrix<T, d>&              its linear part R_j alone
///   const Vector<T, d>&              a vertex
///   std::span<const Affine<T, d>>    any number of nodes, the same for each element
/// Beside it stand kName, kStructure and `over`, which makes the sum. Optional members:
///   kWeight       its weight where a config names none (else 0: off until a config asks for it)
///   kZeroAtRest, kRigidlyInvariant   laws that hold for it, and are then tested
///   jacobian      in place of automatic differentiation, which it is tested against
///   coefficients  the same of a Kronecker term: a of J = aᵀ ⊗ I_d, given the number of nodes
///   offset        and b of r = X a − b, where it brings coefficients
///   set_targets           takes the handles' targets
template <class Term>
struct Terms {
  int arity = 1;
  std::vector<Term> elements{};
  std::vector<int> nodes{};       ///< arity entries an element
  std::vector<double> weights{};  ///< one an element

  void reserve(std::size_t count) {
    elements.reserve(count);
    nodes.reserve(count * arity);
    weights.reserve(count);
  }
  void add(const Term& element, std::span<const int> its_nodes, double weight = 1) {
    elements.push_back(element);
    nodes.insert(nodes.end(), its_nodes.begin(), its_nodes.end());
    weights.push_back(weight);
  }
  void add(const Term& element, std::initializer_list<int> its_nodes, double weight = 1) {
    add(element, std::span(its_nodes.begin(), its_nodes.size()), weight);
  }
};

}  // namespace deformlab
