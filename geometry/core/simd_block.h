#pragma once

namespace deformlab {

/// Four numbers that are added and multiplied at once. They fill two registers of any x86-64
/// processor, or one register of a processor with AVX.
using SimdBlock = double __attribute__((vector_size(32)));
/// A block as a part of an array, where it is aligned as a single number is. It is a struct because
/// Clang takes a reference to a bare vector for aligned, whatever the attributes of its type say.
template <class Block>
struct __attribute__((packed, aligned(8), may_alias)) InMemory {
  Block v;
};

/// The four numbers that begin at p.
inline InMemory<SimdBlock>& simd_block(double* p) {
  return *reinterpret_cast<InMemory<SimdBlock>*>(p);
}
inline const InMemory<SimdBlock>& simd_block(const double* p) {
  return *reinterpret_cast<const InMemory<SimdBlock>*>(p);
}

}  // namespace deformlab
