#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/core/file_lock.h"

namespace deformlab {

/// A folder of results that appears complete or not at all. Files are written to a hidden folder
/// beside it, and `commit` exchanges the two in one step. A manifest in the folder lists what runs
/// have written there. All other files stay, and a run that would have to replace one of them is
/// refused. Without `commit` nothing is left. Two runs that write one folder wait for each other.
/// What a run that was killed has left is removed.
class AtomicFolder {
 public:
  /// `names` are files that will be written, relative to the folder. Throws InputError if the
  /// folder cannot be made or written, or if one of these files belongs to somebody else.
  AtomicFolder(std::filesystem::path target, const std::vector<std::string>& names);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// Has to be called before the first file is written, with the names of all. Throws InputError as
  /// the constructor does.
  void begin(const std::vector<std::string>& names);
  /// Where the files have to be written.
  const std::filesystem::path& path() const { return temporary_; }
  /// Throws InputError if the folder cannot be moved to its place.
  void commit();

 private:
  void make_parents();
  void clean_up() const;
  void make_temporary();
  void keep_old();
  void exchange();
  std::filesystem::path parent() const;
  std::string hidden(const std::string& ending) const;

  std::filesystem::path named_, target_, temporary_;
  std::vector<std::filesystem::path> made_;  ///< parents that were missing, the deepest first
  std::optional<FileLock> lock_;
  bool committed_ = false;
};

}  // namespace deformlab
