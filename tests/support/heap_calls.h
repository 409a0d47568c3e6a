#pragma once

#include <atomic>
#include <cstdlib>
#include <new>

// Counts the heap calls of a whole program. One file of a program may include it.
namespace deformlab::test {

inline std::atomic<long> heap_calls = 0;
inline thread_local bool heap_calls_are_counted = true;

inline void count_heap_call() {
  if (heap_calls_are_counted) ++heap_calls;
}

}  // namespace deformlab::test

#ifdef DEFORMLAB_SANITIZED
// A sanitizer owns malloc: here operator new has to do, and Eigen's calls, which are to malloc, go
// uncounted.
void* operator new(size_t size, const std::nothrow_t&) noexcept {
  deformlab::test::count_heap_call();
  return std::malloc(size);
}
void* operator new(size_t size) {
  deformlab::test::count_heap_call();
  void* p = std::malloc(size);
  if (p == nullptr) throw std::bad_alloc();
  return p;
}
// Inlined, they would look to GCC like a free of what new gave.
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, size_t) noexcept { std::free(p); }
#else
// glibc's malloc, counted.
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t n, size_t size);
void* __libc_realloc(void* p, size_t size);

void* malloc(size_t size) {
  deformlab::test::count_heap_call();
  return __libc_malloc(size);
}
void* calloc(size_t n, size_t size) {
  deformlab::test::count_heap_call();
  return __libc_calloc(n, size);
}
void* realloc(void* p, size_t size) {
  deformlab::test::count_heap_call();
  return __libc_realloc(p, size);
}
}
#endif
