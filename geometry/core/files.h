#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace deformlab {

/// Throws InputError: cannot read 'PATH': WHAT.
[[noreturn]] void cannot_read(const std::filesystem::path& path, const std::string& what);

/// Throws InputError: cannot write 'PATH': WHAT. Or it names an error of the system (errno).
[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& what);
[[noreturn]] void cannot_write(const std::filesystem::path& path, int error);

/// Throws InputError where a file to read is missing or is no file, but a folder, a device, a pipe
/// or a socket. With `pipe_too`, a pipe is admitted.
void check_readable(const std::filesystem::path& path, bool pipe_too = false);

/// All bytes of a file. Throws InputError as check_readable does, and where the file is empty or
/// cannot be read.
std::string read_file(const std::filesystem::path& path);

/// The extension in lower case, with its dot.
std::string extension_of(const std::filesystem::path& path);

/// A file that appears whole or not at all. The bytes go to a temporary file in the same folder,
/// and `commit` moves it to its place. Without a commit the target stays what it was. A symbolic
/// link is followed, and the permissions of an older file are kept. After `commit`, the file
/// survives a crash of the system.
class AtomicFile {
 public:
  /// Throws InputError where the folder is missing or not writable, the name is too long, or the
  /// target is not a file.
  explicit AtomicFile(std::filesystem::path out);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Throws InputError where the bytes could not be written.
  void write(std::string_view bytes);
  /// Throws InputError where not all bytes could be written.
  void commit();
  /// Removes the temporary file. Throws InputError where that is not possible.
  void discard();

 private:
  void check_target();
  void make_temporary();
  void flush();
  [[noreturn]] void fail(int error) const;

  std::filesystem::path out_, target_, temporary_;
  std::filesystem::perms old_mode_ = std::filesystem::perms::unknown;  ///< of an older file
  int descriptor_ = -1;
  std::string buffer_;
};

/// Writes all bytes of a file by an AtomicFile.
void write_file(const std::filesystem::path& out, std::string_view bytes);

/// A name that nobody can guess: `begin`, 16 hexadecimal digits, and `end`.
std::string unpredictable_name(const std::string& begin, const std::string& end);

/// The file or folder that a path leads to by symbolic links, which need not exist.
std::filesystem::path followed(std::filesystem::path path);

/// Whether a file of this name is the temporary file of an AtomicFile.
bool is_temporary(const std::string& name);

/// Removes the temporary files that processes which were killed have left in a folder. Those of
/// processes that live stay.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace deformlab
