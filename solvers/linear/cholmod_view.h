#pragma once

#include <cholmod.h>

#include "solvers/gauss_newton/linearization.h"

namespace deformlab {

/// CHOLMOD's view of the lower triangle of a symmetric matrix in Eigen's arrays: no copy, and valid
/// as long as the matrix is.
inline cholmod_sparse cholmod_view(const SparseMatrix& lower) {
  cholmod_sparse A{};
  A.nrow = lower.rows();
  A.ncol = lower.cols();
  A.nzmax = lower.nonZeros();
  A.p = const_cast<int*>(lower.outerIndexPtr());
  A.i = const_cast<int*>(lower.innerIndexPtr());
  A.x = const_cast<double*>(lower.valuePtr());
  A.stype = -1;  // symmetric, lower triangle stored
  A.itype = CHOLMOD_INT;
  A.xtype = CHOLMOD_REAL;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = 1;
  A.packed = 1;
  return A;
}

}  // namespace deformlab
