#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace deformlab {

/// Throws InputError: cannot read 'PATH': WHAT.
[[noreturn]] void cannot_read(const std::filesystem::path& path, const std::string& what);

/// Throws InputError: cannot write 'PATH': WHAT.
[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& what);

/// All bytes of a file. Throws InputError where it is missing, not a file, empty or not readable.
std::string read_file(const std::filesystem::path& path);

/// The extension in lower case, with its dot.
std::string extension_of(const std::filesystem::path& path);

/// A file that appears whole or not at all. The bytes go to a temporary file in the same folder,
/// and `commit` moves it to its place. Without a commit the target stays what it was. A symbolic
/// link is followed, and the permissions of an older file are kept.
class AtomicFile {
 public:
  /// Throws InputError where the folder is missing or not writable, or the target is not a file.
  explicit AtomicFile(std::filesystem::path out);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  /// Throws InputError where not all bytes could be written.
  void commit();

 private:
  std::filesystem::path out_, target_, temporary_;
  std::ofstream file_;
};

/// Writes all bytes of a file by an AtomicFile.
void write_file(const std::filesystem::path& out, std::string_view bytes);

}  // namespace deformlab
