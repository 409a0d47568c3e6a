#pragma once

// DEFORMLAB_SIMD_DISPATCH before a function: it is compiled for processors with AVX2 as well, and
// the program picks the one that fits where it runs. Sanitizers cannot see through the choice.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define DEFORMLAB_SIMD_DISPATCH __attribute__((target_clones("default", "arch=x86-64-v3")))
#else
#define DEFORMLAB_SIMD_DISPATCH
#endif

// Of a function that clones are made of: it is compiled within each of them, for its processor.
#define DEFORMLAB_INLINED __attribute__((always_inline))
#define DEFORMLAB_INLINE inline DEFORMLAB_INLINED
