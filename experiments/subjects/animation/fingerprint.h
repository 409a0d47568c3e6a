#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace deformlab {

/// Tells whether what a run was made from has changed since (64-bit FNV-1a). No seal against
/// anybody who means to deceive it.
class Fingerprint {
 public:
  void add(std::string_view bytes);
  /// The bytes of a file, a block at a time. Throws InputError where it cannot be read.
  void add_file(const std::filesystem::path& path);
  std::string text() const;  ///< 16 hexadecimal digits

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace deformlab
