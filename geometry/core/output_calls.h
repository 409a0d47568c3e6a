#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string_view>

/// The system calls that change files. Everything that the program writes goes through them, so
/// that a test can let each of them fail. They return 0 or the number of an error (errno).
namespace deformlab::output_calls {

/// What a test puts before every call: it returns the error with which the call is to fail, or 0.
using Fault = int (*)(const char* call);
extern Fault fault;  ///< null outside of tests

/// Opens a new file for writing. Fails where the name exists, even as a symbolic link.
int create(const std::filesystem::path& path, mode_t mode, int& descriptor);
/// Opens a file for the given flags, and makes it if it is missing. Follows no symbolic link.
int open_or_create(const std::filesystem::path& path, int flags, int& descriptor);
/// Writes all bytes.
int write(int descriptor, std::string_view bytes);
int truncate(int descriptor, off_t size);
int set_mode(int descriptor, mode_t mode);
int set_mode(const std::filesystem::path& path, mode_t mode);
/// Returns when the bytes of a file are on the disk, if the file system can tell.
int sync(int descriptor);
/// The same for the names in a folder.
int sync_folder(const std::filesystem::path& folder);
int rename(const std::filesystem::path& from, const std::filesystem::path& to);
/// Two names change their files or folders in one step. ENOSYS, EINVAL or ENOTSUP where the file
/// system cannot do this.
int exchange(const std::filesystem::path& a, const std::filesystem::path& b);
/// A second name for a file. A symbolic link is not followed.
int link(const std::filesystem::path& from, const std::filesystem::path& to);
int make_folder(const std::filesystem::path& path, mode_t mode);
int remove_file(const std::filesystem::path& path);
int remove_folder(const std::filesystem::path& path);  ///< only an empty one

}  // namespace deformlab::output_calls
