#pragma once

#include <cstdint>

namespace deformlab {

/// The hash of what `hash` stands for, followed by a word. Begin with 0. All bits of the result
/// depend on all bits of the words, so that the lowest can number the slots of a table.
constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 0x9E3779B97F4A7C15;
  return hash ^ (hash >> 32);
}

}  // namespace deformlab
