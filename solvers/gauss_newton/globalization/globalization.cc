#include "solvers/gauss_newton/globalization/globalization.h"

#include <utility>

#include "solvers/gauss_newton/globalization/accelerated.h"
#include "solvers/gauss_newton/globalization/full_steps.h"
#include "solvers/gauss_newton/globalization/levenberg.h"
#include "solvers/gauss_newton/globalization/line_search.h"
#include "solvers/registry.h"

namespace deformlab {
namespace {

auto& registry() {
  static Registry<Globalization> globalizations(
      "solver.globalization", {
                                  {"none", [] { return std::make_unique<FullSteps>(); }},
                                  {"line_search", [] { return std::make_unique<LineSearch>(); }},
                                  {"levenberg", [] { return std::make_unique<Levenberg>(); }},
                                  {"accelerated", [] { return std::make_unique<Accelerated>(); }},
                              });
  return globalizations;
}

}  // namespace

void register_globalization(const std::string& name, GlobalizationFactory factory) {
  registry().add(name, std::move(factory));
}

std::unique_ptr<Globalization> make_globalization(const std::string& name) {
  return registry().make(name);
}

std::vector<std::string> globalization_names() { return registry().names(); }

}  // namespace deformlab
