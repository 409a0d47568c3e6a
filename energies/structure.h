#pragma once

#include "energies/energy.h"

namespace deformlab {

/// Throws InputError if a term does not have the structure that it declares: if its Jacobian is not
/// constant although it is declared linear or Kronecker, or not aᵀ ⊗ I_d although it is declared
/// Kronecker. A solver that relied on it would converge to a wrong F. Only a few elements are
/// evaluated, at random states, which takes almost no time.
void check_structure(const Energy& energy);

}  // namespace deformlab
