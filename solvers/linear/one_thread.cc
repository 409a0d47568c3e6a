#include "solvers/linear/one_thread.h"

#include <dlfcn.h>

namespace deformlab {
namespace {

// A function of the OpenMP runtime; null if CHOLMOD does not use it, so that it is not loaded.
template <class Function>
Function find(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

void set_levels(int levels) {
  static const auto set = find<void (*)(int)>("omp_set_max_active_levels");
  if (set != nullptr) set(levels);
}

int get_levels() {
  static const auto get = find<int (*)()>("omp_get_max_active_levels");
  return get != nullptr ? get() : 0;
}

}  // namespace

OneThread::OneThread(int threads) : levels_(get_levels()) {
  if (threads <= 1) set_levels(0);
}

OneThread::~OneThread() { set_levels(levels_); }

}  // namespace deformlab
