#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "energies/term_energy.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// An elastic term over the triangles of a plane, as configs and error messages know it.
struct ElasticTerm {
  std::string name;
  bool needs_orientation;  ///< it cannot begin where a triangle is inside out
  /// The sum over all triangles; the weights are 1 for each unit of area (#F).
  std::unique_ptr<Energy> (*make)(const Triangulation& mesh, const Eigen::VectorXd& weights);
};

/// All elastic terms: ElasticTerms of energies/all.h in the order of the list, then those that were
/// registered.
const std::vector<ElasticTerm>& known_elastic_terms();

/// The term of this name. Throws InputError if there is none; the message lists the known ones.
const ElasticTerm& elastic_term(std::string_view name);

/// Throws InputError if the name is not new.
void add_elastic_term(ElasticTerm term);

template <class Term>
ElasticTerm make_elastic_term() {
  static_assert(TermChecks<Term>::kNamed);
  constexpr bool kNeedsOrientation = requires { requires Term::kNeedsOrientation; };
  return {std::string(Term::kName), kNeedsOrientation,
          [](const Triangulation& mesh, const Eigen::VectorXd& weights) {
            return to_energy(Term::over(mesh, weights));
          }};
}

/// Adds an elastic term of your own: a struct like those in energies/triangle/. From then on it has
/// a weight in configs. Call it from one thread, before anything reads a config or makes a
/// deformer.
template <class Term>
void register_elastic_term() {
  add_elastic_term(make_elastic_term<Term>());
}

}  // namespace deformlab
