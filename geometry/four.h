#pragma once

namespace deformlab {

/// Four numbers that are added and multiplied at once: two registers of every x86-64 processor, one
/// of newer ones.
using Four = double __attribute__((vector_size(32)));
/// The same where it lies in an array, aligned like its numbers.
using FourInMemory = double __attribute__((vector_size(32), aligned(8), may_alias));

/// The four from p on.
inline FourInMemory& four(double* p) { return *reinterpret_cast<FourInMemory*>(p); }
inline const FourInMemory& four(const double* p) {
  return *reinterpret_cast<const FourInMemory*>(p);
}

}  // namespace deformlab
