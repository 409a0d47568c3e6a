#pragma once

namespace deformlab {

/// Four numbers that are added and multiplied at once. They fill two registers of any x86-64
/// processor, or one register of a processor with AVX.
using SimdBlock = double __attribute__((vector_size(32)));
/// The same four numbers as a part of an array, where they are aligned as single numbers are.
using SimdBlockInMemory = double __attribute__((vector_size(32), aligned(8), may_alias));

/// The four numbers that begin at p.
inline SimdBlockInMemory& simd_block(double* p) { return *reinterpret_cast<SimdBlockInMemory*>(p); }
inline const SimdBlockInMemory& simd_block(const double* p) {
  return *reinterpret_cast<const SimdBlockInMemory*>(p);
}

}  // namespace deformlab
