#pragma once

#include <filesystem>
#include <string>

namespace deformlab {

/// Throws InputError: cannot read 'PATH': WHAT.
[[noreturn]] void cannot_read(const std::filesystem::path& path, const std::string& what);

/// All bytes of a file. Throws InputError where it is missing, not a file, empty or not readable.
std::string read_bytes(const std::filesystem::path& path);

/// The extension in lower case, with its dot.
std::string extension_of(const std::filesystem::path& path);

}  // namespace deformlab
