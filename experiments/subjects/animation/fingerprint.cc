#include "experiments/subjects/animation/fingerprint.h"

#include <fmt/format.h>

#include "geometry/core/files.h"

namespace deformlab {
namespace {

constexpr std::uint64_t kPrime = 0x100000001b3;

}  // namespace

void Fingerprint::add(std::string_view bytes) {
  for (const char c : bytes) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * kPrime;
  hash_ = (hash_ ^ bytes.size()) * kPrime;  // so that "ab", "c" differs from "a", "bc"
}

void Fingerprint::add_file(const std::filesystem::path& path) { add(read_file(path)); }

std::string Fingerprint::text() const { return fmt::format("{:016x}", hash_); }

}  // namespace deformlab
