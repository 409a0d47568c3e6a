#pragma once

namespace deformlab {

/// SimdBlock numbers that are added and multiplied at once: two registers of every x86-64
/// processor, one of newer ones.
using SimdBlock = double __attribute__((vector_size(32)));
/// The same where it lies in an array, aligned like its numbers.
using SimdBlockInMemory = double __attribute__((vector_size(32), aligned(8), may_alias));

/// The four from p on.
inline SimdBlockInMemory& simd_block(double* p) { return *reinterpret_cast<SimdBlockInMemory*>(p); }
inline const SimdBlockInMemory& simd_block(const double* p) {
  return *reinterpret_cast<const SimdBlockInMemory*>(p);
}

}  // namespace deformlab
