#include "experiments/subjects/animation/fingerprint.h"

#include <cstdio>
#include <fstream>
#include <vector>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr std::uint64_t kPrime = 0x100000001b3;
constexpr std::size_t kBlock = 1 << 16;

}  // namespace

void Fingerprint::add(std::string_view bytes) {
  for (const char c : bytes) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * kPrime;
  hash_ = (hash_ ^ bytes.size()) * kPrime;  // "ab", "c" is not "a", "bc"
}

void Fingerprint::add_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> block(kBlock);
  while (file) {
    file.read(block.data(), std::ssize(block));
    add({block.data(), static_cast<std::size_t>(file.gcount())});
  }
  if (!file.eof()) throw InputError("cannot read '" + path.string() + "' to its end");
}

std::string Fingerprint::text() const {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash_));
  return text;
}

}  // namespace deformlab
