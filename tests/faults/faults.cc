// Lets calls that change files fail in the program of the tests that is called deformlab_faulty.
// DEFORMLAB_FAULT=NUMBER:KIND:FILE names the first call by its number, counted from 1. KIND is
// `die` (the process is killed before the call), `once` (the call fails with ENOSPC) or `always`
// (the call and all later ones fail with EIO). FILE appears if the call was reached.
// DEFORMLAB_LACKS=CALL is about a file system that does not have a call, such as renameat2.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>

#include "geometry/core/output_calls.h"

namespace {

int first = 0;
std::string kind, log_file, lacking;

int fault(const char* call) {
  static int count = 0;
  if (call == lacking) return ENOSYS;
  const bool hit = ++count == first || (count > first && kind == "always");
  if (!hit) return 0;
  ::close(::open(log_file.c_str(), O_WRONLY | O_CREAT, 0600));
  if (kind == "die") ::kill(::getpid(), SIGKILL);
  return kind == "once" ? ENOSPC : EIO;
}

[[maybe_unused]] const bool is_set = [] {
  if (const char* call = std::getenv("DEFORMLAB_LACKS")) {
    lacking = call;
    deformlab::output_calls::fault = fault;
  }
  const char* wanted = std::getenv("DEFORMLAB_FAULT");
  if (wanted == nullptr) return false;
  const std::string text = wanted;
  const std::size_t colon = text.find(':'), second = text.find(':', colon + 1);
  first = std::stoi(text);
  kind = text.substr(colon + 1, second - colon - 1);
  log_file = text.substr(second + 1);
  deformlab::output_calls::fault = fault;
  return true;
}();

}  // namespace
