#pragma once

#include <string>
#include <vector>

#include "experiments/subjects/subject.h"

namespace deformlab {

/// A command line whose flags were read.
struct Flags {
  std::vector<std::string> words{};   ///< what is no flag, in order; the first one is the command
  std::string frames{}, particles{};  ///< the inputs of `animate`
  CommandLine line{};                 ///< the values of the other flags; without an input
};

/// Reads `--name value`, `--name=value` and `--name` anywhere among the words. Throws InputError
/// for an unknown flag, for one without its value, and for a value of the wrong type.
Flags parse_flags(const std::vector<std::string>& arguments);

}  // namespace deformlab
