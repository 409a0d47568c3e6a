#include "energies/catalog.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "energies/all.h"
#include "energies/register_energy.h"
#include "geometry/core/error.h"
#include "geometry/core/options.h"

namespace deformlab {
namespace {

struct Catalog {
  std::vector<EnergyInfo> infos;
  std::vector<CatalogEntry> entries;

  void add(CatalogEntry entry) {
    infos.push_back(entry.info);
    entries.push_back(std::move(entry));
  }
};

template <template <class> class... Term>
Catalog built_in(GraphTermList<Term...>) {
  Catalog catalog;
  (catalog.add(catalog_entry<Term>()), ...);
  return catalog;
}

Catalog& catalog() {
  static Catalog all = built_in(GraphTerms{});
  return all;
}

const CatalogEntry& find(std::string_view name) {
  std::vector<std::string> known;
  for (const CatalogEntry& entry : catalog().entries) {
    if (entry.info.name == name) return entry;
    known.push_back(entry.info.name);
  }
  throw InputError(fmt::format("unknown energy '{}'; known: {}", name, fmt::join(known, ", ")));
}

}  // namespace

void add_to_catalog(CatalogEntry entry) {
  for (const EnergyInfo& info : catalog().infos) {
    if (info.name != entry.info.name) continue;
    throw InputError(fmt::format(
        "the term '{}' is registered already; give the new one another kName", info.name));
  }
  catalog().add(std::move(entry));
}

const std::vector<EnergyInfo>& known_energies() { return catalog().infos; }

const EnergyInfo& energy_info(std::string_view name) { return find(name).info; }

std::unique_ptr<Energy> make_energy(std::string_view name, const GraphContext& context,
                                    const OptionValues& options) {
  const CatalogEntry& entry = find(name);
  check_option_names(entry.info.name, entry.info.options, options);
  const bool rigid = context.model == NodeModel::kRigid;
  const MakeEnergy make = rigid                    ? entry.rigid
                          : context.dimension == 2 ? entry.in_plane
                                                   : entry.in_space;
  if (make) return make(context, options);
  throw InputError(fmt::format(
      "the term '{}' is not defined for {}: its call operator reads columns that they do not have",
      name, rigid ? "rigid nodes" : fmt::format("nodes in {} dimensions", context.dimension)));
}

void check_settings(const std::map<std::string, TermSettings>& energies) {
  for (const auto& [name, settings] : energies) {
    check_option_names(name, energy_info(name).options, settings.options);
    const double weight = settings.weight.value_or(0);
    if (weight >= 0 && std::isfinite(weight)) continue;
    throw OptionError(fmt::format("energies.{}", name), fmt::format("{}", weight),
                      "; a weight is a number of at least 0");
  }
}

}  // namespace deformlab
