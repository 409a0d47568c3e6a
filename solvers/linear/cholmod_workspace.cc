#include "solvers/linear/cholmod_workspace.h"

namespace deformlab {

CholmodWorkspace::CholmodWorkspace() {
  cholmod_start(&common);
  common.print = 0;
  common.try_catch = 1;
}

CholmodWorkspace::~CholmodWorkspace() { cholmod_finish(&common); }

void CholmodWorkspace::use_ordering(int ordering, bool postorder) {
  common.nmethods = 1;
  common.method[0].ordering = ordering;
  common.postorder = postorder ? 1 : 0;
}

cholmod_sparse cholmod_view(const SparseMatrix& lower) {
  cholmod_sparse A{};
  A.nrow = lower.rows();
  A.ncol = lower.cols();
  A.nzmax = lower.nonZeros();
  A.p = const_cast<int*>(lower.outerIndexPtr());
  A.i = const_cast<int*>(lower.innerIndexPtr());
  A.x = const_cast<double*>(lower.valuePtr());
  A.stype = -1;  // symmetric, the lower triangle is stored
  A.itype = CHOLMOD_INT;
  A.xtype = CHOLMOD_REAL;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = 1;
  A.packed = 1;
  return A;
}

}  // namespace deformlab
