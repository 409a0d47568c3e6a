#pragma once

#include <stdexcept>
#include <string>

namespace deformlab {

/// An input of the user cannot be used. The message is one line for the user: it says what the
/// input is, its value, what is allowed and how to correct it.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace deformlab
