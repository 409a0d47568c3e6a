#pragma once

#include <cholmod.h>

#include "solvers/linear/sparse_matrix.h"

namespace deformlab {

/// CHOLMOD's settings and workspace. CHOLMOD prints nothing, and a matrix that is not positive
/// definite is a result for the caller to handle, not a message on the error stream.
struct CholmodWorkspace {
  CholmodWorkspace();
  ~CholmodWorkspace();
  CholmodWorkspace(const CholmodWorkspace&) = delete;
  CholmodWorkspace& operator=(const CholmodWorkspace&) = delete;

  /// Lets cholmod_analyze compute this ordering (CHOLMOD_AMD, CHOLMOD_NATURAL, …) and no other.
  ///   postorder  whether the ordering is then sorted by a postorder of the elimination tree
  void use_ordering(int ordering, bool postorder);

  cholmod_common common;
};

/// CHOLMOD's view of the lower triangle of a symmetric matrix in Eigen's arrays. Nothing is copied:
/// the view is valid as long as the matrix is.
cholmod_sparse cholmod_view(const SparseMatrix& lower);

}  // namespace deformlab
