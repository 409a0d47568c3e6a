#include "energies/catalog.h"

#include "energies/all.h"
#include "energies/term_energy.h"
#include "geometry/core/error.h"

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

const std::vector<Entry>& rigid_catalog() {
  static const std::vector<Entry> all = entries(RigidTerms{});
  return all;
}

std::vector<EnergyInfo> infos_of(const std::vector<Entry>& all) {
  std::vector<EnergyInfo> result;
  for (const Entry& entry : all) result.push_back(entry.info);
  return result;
}

std::unique_ptr<Energy> make_named(const std::vector<Entry>& all, std::string_view name,
                                   const DeformationGraph& graph, const Embedding& handles) {
  std::string known;
  for (const Entry& entry : all) {
    if (entry.info.name == name) return entry.make(graph, handles);
    known += (known.empty() ? "" : ", ") + entry.info.name;
  }
  throw InputError("unknown energy '" + std::string(name) + "'; known: " + known);
}

}  // namespace

const std::vector<EnergyInfo>& known_energies() {
  static const std::vector<EnergyInfo> infos = infos_of(catalog<3>());
  return infos;
}

const std::vector<EnergyInfo>& known_rigid_energies() {
  static const std::vector<EnergyInfo> infos = infos_of(rigid_catalog());
  return infos;
}

std::unique_ptr<Energy> make_rigid_energy(std::string_view name, const DeformationGraph& graph,
                                          const Embedding& handles) {
  return make_named(rigid_catalog(), name, graph, handles);
}

std::unique_ptr<Energy> make_energy(std::string_view name, const DeformationGraph& graph,
                                    const Embedding& handles, int d) {
  return make_named(d == 2 ? catalog<2>() : catalog<3>(), name, graph, handles);
}

}  // namespace deformlab
