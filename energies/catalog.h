#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "energies/energy.h"
#include "energies/graph/context.h"
#include "energies/term_options.h"

namespace deformlab {

/// A term over a deformation graph, as configs and error messages know it.
struct EnergyInfo {
  std::string name;
  Structure structure;    ///< for affine nodes
  double default_weight;  ///< if a config does not name the term
  bool for_rigid_nodes;   ///< false if the term reads R_j as a matrix of unknowns
  std::vector<OptionInfo> options;
};

/// All terms: those of energies/all.h in the order of the list, then those that were registered.
const std::vector<EnergyInfo>& known_energies();

/// The term of this name. Throws InputError if there is none; the message lists the known ones.
const EnergyInfo& energy_info(std::string_view name);

/// Makes the term of this name, summed over a graph and handles. Throws InputError for an unknown
/// name, an option that the term does not have or cannot take, and a term that is not defined for
/// the context's model of nodes.
std::unique_ptr<Energy> make_energy(std::string_view name, const GraphContext& context,
                                    const OptionValues& options = {});

/// The settings of one term: its weight w, which has a default, and its own options. A number alone
/// is the weight.
struct TermSettings {
  std::optional<double> weight{};
  OptionValues options{};

  TermSettings() = default;
  TermSettings(double w)
      : weight(w) {}  // NOLINT(google-explicit-constructor): energies["volume"] = 2
  TermSettings(std::optional<double> w, OptionValues o) : weight(w), options(std::move(o)) {}
};

/// Throws InputError for an unknown term, a weight that is negative or not a number, and an option
/// that the term does not have.
void check_settings(const std::map<std::string, TermSettings>& energies);

}  // namespace deformlab
