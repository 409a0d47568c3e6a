#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "energies/energy.h"
#include "geometry/graph/deformation_graph.h"

namespace deformlab {

/// A registered energy term (energies/all.h), as configs and error messages know it.
struct EnergyInfo {
  std::string name;
  Structure structure;
  double default_weight;  ///< where a config does not name it
};

/// Every registered term, in the order of the list.
const std::vector<EnergyInfo>& known_energies();

/// The terms of nodes that are rotations by construction (energies/graph/rotation_vector.h), summed
/// likewise, with their weights where none is named. They have the names of those they stand for.
const std::vector<EnergyInfo>& known_rigid_energies();
std::unique_ptr<Energy> make_rigid_energy(std::string_view name, const DeformationGraph& graph,
                                          const Embedding& handles);

/// The named term, summed over a graph and its handles. `handles` are embedded in the same graph,
/// in the same unit of length. d = 2 is the term of the plane, for which the z of both counts
/// nothing. Throws InputError for an unknown name.
std::unique_ptr<Energy> make_energy(std::string_view name, const DeformationGraph& graph,
                                    const Embedding& handles, int d = 3);

}  // namespace deformlab
