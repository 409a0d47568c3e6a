#pragma once

#include <filesystem>
#include <vector>

namespace deformlab {

/// A folder that appears whole or not at all. Files are written to a hidden folder beside it, and
/// `commit` moves that folder to its place. An older folder of the same name is replaced only then;
/// files in it that others have put there stay. Without a commit nothing stays.
class AtomicFolder {
 public:
  /// Whether a file or folder in the older folder is one of ours, which the new one may lack.
  using IsOurs = bool (*)(const std::filesystem::path& name);

  /// Throws InputError where the folder cannot be made or written, before any work is done for it.
  AtomicFolder(std::filesystem::path target, IsOurs is_ours);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  const std::filesystem::path& path() const { return temporary_; }
  /// Throws InputError where the folder cannot be moved to its place.
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  IsOurs is_ours_;
  std::vector<std::filesystem::path> made_;  ///< missing folders on the way, the deepest first
};

}  // namespace deformlab
