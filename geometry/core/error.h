#pragma once

#include <stdexcept>
#include <string>

namespace deformlab {

/// Something the user gave cannot be used. The message says what it is, its value, what is allowed
/// and how to mend it, in one line that can be shown as it stands.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace deformlab
