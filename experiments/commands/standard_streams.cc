#include "experiments/commands/standard_streams.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>

#include "geometry/core/error.h"
#include "geometry/core/output_calls.h"

namespace deformlab {

void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // A new descriptor is the smallest that is free, so it is this one.
    if (::open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY) != stream) std::abort();
  }
  std::signal(SIGPIPE, SIG_IGN);
}

void print_out(std::string_view text) {
  const int error = output_calls::write(STDOUT_FILENO, text);
  if (error == EPIPE) throw BrokenPipe();
  if (error == 0) return;
  throw InputError(fmt::format("cannot write to the standard output: {}",
                               std::generic_category().message(error)));
}

}  // namespace deformlab
