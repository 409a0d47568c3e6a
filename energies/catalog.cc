#include "energies/catalog.h"

#include "energies/all.h"
#include "energies/term_energy.h"
#include "geometry/error.h"

namespace deformlab {
namespace {

template <class Term>
double default_weight() {
  if constexpr (requires { Term::kWeight; }) return Term::kWeight;
  return 0;
}

template <class Term>
std::unique_ptr<Energy> make(const DeformationGraph& graph, const Embedding& handles) {
  if constexpr (requires { Term::over(graph, handles); }) {
    return std::make_unique<TermEnergy<Term>>(Term::over(graph, handles));
  } else {
    return std::make_unique<TermEnergy<Term>>(Term::over(graph));
  }
}

struct Entry {
  EnergyInfo info;
  std::unique_ptr<Energy> (*make)(const DeformationGraph&, const Embedding&);
};

template <class... Term>
std::vector<Entry> entries(TermList<Term...>) {
  return {{{std::string(Term::kName), Term::kStructure, default_weight<Term>()}, &make<Term>}...};
}

template <int d>
const std::vector<Entry>& catalog() {
  static const std::vector<Entry> all = entries(GraphTerms<d>{});
  return all;
}

}  // namespace

const std::vector<EnergyInfo>& known_energies() {
  static const std::vector<EnergyInfo> infos = [] {
    std::vector<EnergyInfo> result;
    for (const Entry& entry : catalog<3>()) result.push_back(entry.info);
    return result;
  }();
  return infos;
}

std::unique_ptr<Energy> make_energy(std::string_view name, const DeformationGraph& graph,
                                    const Embedding& handles, int d) {
  std::string known;
  for (const Entry& entry : d == 2 ? catalog<2>() : catalog<3>()) {
    if (entry.info.name == name) return entry.make(graph, handles);
    known += (known.empty() ? "" : ", ") + entry.info.name;
  }
  throw InputError("unknown energy '" + std::string(name) + "'; known: " + known);
}

}  // namespace deformlab
