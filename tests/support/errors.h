#pragma once

#include <string>
#include <utility>

#include "geometry/core/error.h"

namespace deformlab::test {

/// The message of the InputError that the action throws, or nothing where it throws none.
template <class Action>
std::string error_of(Action&& action) {
  try {
    std::forward<Action>(action)();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace deformlab::test
