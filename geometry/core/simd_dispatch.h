#pragma once

// DEFORMLAB_SIMD_DISPATCH before a function compiles it twice, for every x86-64 processor and for
// those with AVX2 (function multiversioning); the program chooses when it starts. Sanitizers do not
// support this.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define DEFORMLAB_SIMD_DISPATCH __attribute__((target_clones("default", "arch=x86-64-v3")))
#else
#define DEFORMLAB_SIMD_DISPATCH
#endif

// For a function that a dispatched function calls: it becomes a part of every version of the caller
// and so is compiled for the same processor.
#define DEFORMLAB_INLINED __attribute__((always_inline))
#define DEFORMLAB_INLINE inline DEFORMLAB_INLINED
