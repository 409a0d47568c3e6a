#include "geometry/core/file_lock.h"

#include <glog/logging.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "geometry/core/files.h"
#include "geometry/core/output_calls.h"

namespace deformlab {
namespace {

// Whether the path still names this file: the process that had the lock before may have removed it.
bool names(const std::filesystem::path& path, int descriptor) {
  struct stat file = {}, named = {};
  return ::fstat(descriptor, &file) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         file.st_ino == named.st_ino && file.st_dev == named.st_dev;
}

}  // namespace

FileLock::FileLock(std::filesystem::path path, const std::string& what, int flags)
    : path_(std::move(path)) {
  for (;;) {
    if (const int error = output_calls::open_or_create(path_, flags, descriptor_)) {
      cannot_write(path_, error);
    }
    if (lock(what)) return;
    ::close(descriptor_);
  }
}

// Returns whether the lock is that of the path.
bool FileLock::lock(const std::string& what) {
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    excludes_others_ = errno == EWOULDBLOCK;
    if (!excludes_others_) return true;
    LOG(WARNING) << "waiting for another run that writes " << what;
    while (::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  return names(path_, descriptor_);
}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  output_calls::remove_file(path_);
  ::close(descriptor_);
}

void FileLock::release() {
  if (const int error = output_calls::remove_file(path_)) cannot_write(path_, error);
  keep_file();
}

void FileLock::keep_file() {
  ::close(descriptor_);
  descriptor_ = -1;
}

}  // namespace deformlab
