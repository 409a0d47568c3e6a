#pragma once

#include <functional>
#include <stdexcept>
#include <streambuf>
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

/// Passes the text of a std::ostream on to print_out, for libraries that write to one. The stream
/// has to be told to let exceptions through: `stream.exceptions(std::ios::badbit)`.
class OutBuffer : public std::streambuf {
 protected:
  int_type overflow(int_type c) override;
  std::streamsize xsputn(const char* text, std::streamsize size) override;
};

/// Opens the standard streams, calls action(), and returns the exit status of the program, which
/// messages call `name`: that of the action, 2 after an InputError, 141 after a BrokenPipe, or 4
/// after any other exception.
int run_program(const char* name, const std::function<int()>& action);

}  // namespace deformlab
