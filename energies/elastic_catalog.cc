#include "energies/elastic_catalog.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "energies/all.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

template <class... Term>
std::vector<ElasticTerm> built_in(TermList<Term...>) {
  return {make_elastic_term<Term>()...};
}

std::vector<ElasticTerm>& catalog() {
  static std::vector<ElasticTerm> all = built_in(ElasticTerms{});
  return all;
}

}  // namespace

const std::vector<ElasticTerm>& known_elastic_terms() { return catalog(); }

const ElasticTerm& elastic_term(std::string_view name) {
  const auto found = std::ranges::find(catalog(), name, &ElasticTerm::name);
  if (found != catalog().end()) return *found;
  std::vector<std::string> known;
  for (const ElasticTerm& term : catalog()) known.push_back(term.name);
  throw InputError(
      fmt::format("unknown elastic term '{}'; known: {}", name, fmt::join(known, ", ")));
}

void add_elastic_term(ElasticTerm term) {
  if (std::ranges::find(catalog(), term.name, &ElasticTerm::name) != catalog().end()) {
    throw InputError(fmt::format(
        "the term '{}' is registered already; give the new one another kName", term.name));
  }
  catalog().push_back(std::move(term));
}

}  // namespace deformlab
