#include "energies/term.h"

#include <fmt/format.h>

#include "geometry/core/error.h"

namespace deformlab {

void throw_wrong_nodes(std::string_view term, std::size_t element, std::size_t given, int arity) {
  throw InputError(
      fmt::format("element {} of the term '{}' was given {} node{}, but each element of it reads "
                  "{}; give it as "
                  "many nodes as its call operator has arguments, or as its first element has",
                  element, term, given, given == 1 ? "" : "s",
                  arity == 0 ? "at least 1" : fmt::to_string(arity)));
}

void throw_wrong_weight(std::string_view term, std::size_t element, double weight) {
  throw InputError(fmt::format(
      "element {} of the term '{}' was given the weight {}; a weight is a number of 0 or more",
      element, term, weight));
}

}  // namespace deformlab
