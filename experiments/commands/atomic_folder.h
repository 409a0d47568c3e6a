#pragma once

#include <filesystem>
#include <vector>

namespace deformlab {

/// A folder that appears complete or not at all. Files are written to a hidden folder beside it,
/// and `commit` moves that folder to its place. Only then does it replace an older folder of the
/// same name, and it keeps the files that others have put there. Without `commit` nothing is left.
class AtomicFolder {
 public:
  /// Whether a file or folder in the older folder is ours, so that it need not be kept.
  using IsOurs = bool (*)(const std::filesystem::path& name);

  /// Throws InputError if the folder cannot be made or written.
  AtomicFolder(std::filesystem::path target, IsOurs is_ours);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  const std::filesystem::path& path() const { return temporary_; }
  /// Throws InputError if the folder cannot be moved to its place.
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  IsOurs is_ours_;
  std::vector<std::filesystem::path> made_;  ///< parents that were missing, the deepest first
};

}  // namespace deformlab
