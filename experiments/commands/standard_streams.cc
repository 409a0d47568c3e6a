#include "experiments/commands/standard_streams.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
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

OutBuffer::int_type OutBuffer::overflow(int_type c) {
  const char text = traits_type::to_char_type(c);
  if (!traits_type::eq_int_type(c, traits_type::eof())) print_out({&text, 1});
  return traits_type::not_eof(c);
}

std::streamsize OutBuffer::xsputn(const char* text, std::streamsize size) {
  print_out({text, static_cast<std::size_t>(size)});
  return size;
}

int run_program(const char* name, const std::function<int()>& action) {
  open_standard_streams();
  try {
    return action();
  } catch (const BrokenPipe&) {
    return 128 + SIGPIPE;  // as shells report a program that a broken pipe has ended
  } catch (const InputError& e) {
    std::fprintf(stderr, "%s: %s\n", name, e.what());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "%s: out of memory: use fewer nodes or a smaller shape\n", name);
    return 4;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", name, e.what());
    return 4;
  }
}

}  // namespace deformlab
