#include "geometry/core/output_calls.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

namespace deformlab::output_calls {

constinit Fault fault = nullptr;

namespace {

// The error of a call that returns a negative number if it fails.
template <class Call>
int error_of(const char* name, Call&& call) {
  if (fault != nullptr) {
    if (const int error = fault(name)) return error;
  }
  for (;;) {
    if (call() >= 0) return 0;
    if (errno != EINTR) return errno;
  }
}

}  // namespace

int create(const std::filesystem::path& path, mode_t mode, int& descriptor) {
  constexpr int kFlags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  return error_of("open", [&] { return descriptor = ::open(path.c_str(), kFlags, mode); });
}

int open_or_create(const std::filesystem::path& path, int flags, int& descriptor) {
  const int all = flags | O_CREAT | O_NOFOLLOW | O_CLOEXEC;
  return error_of("open", [&] { return descriptor = ::open(path.c_str(), all, 0666); });
}

int write(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    ssize_t written = 0;
    const int error = error_of(
        "write", [&] { return written = ::write(descriptor, bytes.data(), bytes.size()); });
    if (error != 0) return error;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int truncate(int descriptor, off_t size) {
  return error_of("ftruncate", [&] { return ::ftruncate(descriptor, size); });
}

int set_mode(int descriptor, mode_t mode) {
  return error_of("fchmod", [&] { return ::fchmod(descriptor, mode); });
}

int set_mode(const std::filesystem::path& path, mode_t mode) {
  return error_of("chmod", [&] { return ::chmod(path.c_str(), mode); });
}

int sync(int descriptor) {
  const int error = error_of("fsync", [&] { return ::fsync(descriptor); });
  return error == EINVAL ? 0 : error;  // the file system has nothing to sync
}

int sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno == EACCES ? 0 : errno;  // may be written, but not listed
  const int error = sync(descriptor);
  ::close(descriptor);
  return error;
}

int rename(const std::filesystem::path& from, const std::filesystem::path& to) {
  return error_of("rename", [&] { return std::rename(from.c_str(), to.c_str()); });
}

int exchange(const std::filesystem::path& a, const std::filesystem::path& b) {
  return error_of("renameat2", [&] {
    return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE);
  });
}

int link(const std::filesystem::path& from, const std::filesystem::path& to) {
  return error_of("linkat",
                  [&] { return ::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), 0); });
}

int make_folder(const std::filesystem::path& path, mode_t mode) {
  return error_of("mkdir", [&] { return ::mkdir(path.c_str(), mode); });
}

int remove_file(const std::filesystem::path& path) {
  return error_of("unlink", [&] { return ::unlink(path.c_str()); });
}

int remove_folder(const std::filesystem::path& path) {
  return error_of("rmdir", [&] { return ::rmdir(path.c_str()); });
}

}  // namespace deformlab::output_calls
