#pragma once

#include <stdexcept>
#include <string_view>

namespace deformlab {

/// Nobody reads the standard output any more, as after `| head -1`. The program ends without a
/// message.
struct BrokenPipe : std::runtime_error {
  BrokenPipe() : std::runtime_error("nobody reads the standard output") {}
};

/// Has to be called before anything is opened. Opens the standard streams that the program was
/// started without on /dev/null, so that no file gets their numbers and then their messages. From
/// here on a write to a broken pipe fails and does not kill the program.
void open_standard_streams();

/// Writes results to the standard output at once. Throws BrokenPipe, or InputError if they cannot
/// be written.
void print_out(std::string_view text);

}  // namespace deformlab
