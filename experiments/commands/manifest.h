#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace deformlab {

inline constexpr const char* kManifest = "manifest.txt";

/// The list of files that runs have written into a folder of results. Only these may a later run
/// replace or delete; all other files belong to somebody else.
class Manifest {
 public:
  /// Reads the list of a folder. Without a list, or with a file of that name that is not ours, it
  /// is empty.
  explicit Manifest(std::filesystem::path folder);

  /// The files of the list, relative to the folder, also those that are gone.
  const std::set<std::string>& names() const { return names_; }
  /// Whether a path in the folder, relative to it, is a file of the list. A link is never one.
  bool lists(const std::filesystem::path& name) const;
  /// Whether all files of the list are there.
  bool is_complete() const;

  /// Throws InputError if the list and files of these names cannot be written without loss, because
  /// something that no list names is in the way.
  void check_free(std::vector<std::string> names) const;

  static std::string text(const std::vector<std::string>& names);

 private:
  std::filesystem::path folder_;
  std::set<std::string> names_;
};

/// Gives a new folder of results all files of the old one that the manifest of the old one does not
/// list. They get a second name and are not copied. Files that both have keep their permissions.
/// Throws InputError where the disk is full or broken.
void keep_foreign(const std::filesystem::path& old, const std::filesystem::path& fresh);

/// Deletes a folder that `now` has replaced: what its manifest lists, and names of files that `now`
/// has too. Whatever else is in it moves to `now`. Returns false if something has to stay in it,
/// because `now` has another file of that name.
bool discard(const std::filesystem::path& old, const std::filesystem::path& now);

}  // namespace deformlab
