#pragma once

#include <algorithm>

#include "energies/catalog.h"
#include "energies/graph/nodes.h"
#include "energies/term_energy.h"

namespace deformlab {

using MakeEnergy = std::unique_ptr<Energy> (*)(const GraphContext&, const OptionValues&);

/// A term of the catalog. A function is null if the term is not defined for that model of nodes.
struct CatalogEntry {
  EnergyInfo info;
  MakeEnergy in_space, in_plane, rigid;
};

/// Throws InputError if the name is not new.
void add_to_catalog(CatalogEntry entry);

/// Whether such a node has the columns that each argument of the term reads. A rigid node has too
/// few for a term that reads R_j as a matrix.
template <class Term, class Node>
constexpr bool fits() {
  using Plain = SignatureOf<Term>;
  const auto& columns = Plain::kColumns;
  return Plain::kDimension == Node::kDimension &&
         std::all_of(columns.begin(), columns.end(), [](int c) { return c <= Node::kColumns; });
}

template <class Term>
std::unique_ptr<Energy> make_term(const GraphContext& context, const OptionValues& values) {
  static_assert(
      HasOptions<Term> || requires { Term::over(context); },
      "a term over a graph needs its sum: static Terms<...> over(const GraphContext&)");
  if constexpr (HasOptions<Term>) {
    static_assert(
        requires(const typename Term::Options& options) { Term::over(context, options); },
        "a term with Options needs its sum: "
        "static Terms<...> over(const GraphContext&, const Options&)");
    const auto options = make_options<typename Term::Options>(std::string(Term::kName), values);
    return to_energy(Term::over(context, options));
  } else if constexpr (requires { Term::over(context); }) {
    return to_energy(Term::over(context));
  }
}

template <class Term, class Node>
constexpr MakeEnergy maker() {
  if constexpr (fits<Term, Node>()) return &make_term<Term>;
  return nullptr;
}

template <template <class> class Term>
CatalogEntry catalog_entry() {
  using Plain = Term<AffineNode<3>>;
  static_assert(TermChecks<Plain>::kNamed);
  EnergyInfo info{
      std::string(Plain::kName), structure_of<Plain>(), 0, fits<Term<RigidNode>, RigidNode>(), {}};
  if constexpr (requires { Plain::kWeight; }) info.default_weight = Plain::kWeight;
  if constexpr (HasOptions<Plain>) info.options = describe_options<typename Plain::Options>();
  return {std::move(info), maker<Plain, AffineNode<3>>(),
          maker<Term<AffineNode<2>>, AffineNode<2>>(), maker<Term<RigidNode>, RigidNode>()};
}

/// Adds a term of your own to the catalog: `register_energy<Volume>();` for a struct
/// `template <class Node> struct Volume`. From then on it has a name in configs and options, a
/// weight, a loss and options, and both solvers minimise it, as with the built-in terms. Call it
/// from one thread, before anything reads a config or makes a deformer. Throws InputError if there
/// is a term of that name already.
template <template <class> class Term>
void register_energy() {
  add_to_catalog(catalog_entry<Term>());
}

}  // namespace deformlab
