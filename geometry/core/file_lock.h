#pragma once

#include <filesystem>
#include <string>

namespace deformlab {

/// Only one process at a time has the lock of a path. The lock is a file, which goes with it.
/// Where the file system has no locks, everyone gets it at once.
class FileLock {
 public:
  /// Waits while another process has the lock, and warns that `what` is busy. `flags` are those of
  /// open(2); the file is made if it is missing. Throws InputError where it cannot be made.
  FileLock(std::filesystem::path path, const std::string& what, int flags = 0);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  int descriptor() const { return descriptor_; }
  bool excludes_others() const { return excludes_others_; }
  /// Ends the lock and removes its file. Throws InputError if the file cannot be removed.
  void release();
  /// Ends the lock and lets its file stay.
  void keep_file();

 private:
  bool lock(const std::string& what);

  std::filesystem::path path_;
  int descriptor_ = -1;
  bool excludes_others_ = true;
};

}  // namespace deformlab
