#include "solvers/options.h"

#include "solvers/gauss_newton/globalization/globalization.h"
#include "solvers/gauss_newton/step_solvers/step_solver.h"

namespace deformlab {

std::vector<std::string> linear_solver_choices(SolverMethod method) {
  if (method == SolverMethod::kCeres) {
    return {"dense_qr",    "dense_normal_cholesky", "sparse_normal_cholesky",
            "dense_schur", "sparse_schur",          "iterative_schur",
            "cgnr"};
  }
  std::vector<std::string> names = step_solver_names();
  std::erase(names, "auto");
  return names;
}

std::vector<std::string> linear_solver_choices() {
  std::vector<std::string> names{"auto"};
  for (const auto& entry : names_of(SolverMethod{})) {
    for (std::string& name : linear_solver_choices(entry.value)) names.push_back(std::move(name));
  }
  return names;
}

std::vector<std::string> globalization_choices() { return globalization_names(); }

}  // namespace deformlab
