#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace deformlab {

/// A hash (64-bit FNV-1a) of all that a run depends on, which shows whether any of it has changed.
/// It is not cryptographic.
class Fingerprint {
 public:
  void add(std::string_view bytes);
  /// Adds the bytes of a file. Throws InputError if it cannot be read.
  void add_file(const std::filesystem::path& path);
  std::string text() const;  ///< 16 hexadecimal digits

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace deformlab
