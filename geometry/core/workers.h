#pragma once

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#ifdef __SANITIZE_THREAD__
#include <thread>
#include <vector>
#endif

namespace deformlab {

/// Threads that share pieces of work. The pieces must not depend on the number of threads, so that
/// results do not depend on it either. With one thread a call is a loop that allocates nothing.
class Workers {
 public:
  ///   threads  0: as many as the machine has
  explicit Workers(int threads = 1)
      : threads_(threads > 0 ? threads : tbb::info::default_concurrency()), arena_(threads_) {}

  int threads() const { return threads_; }

  /// Calls work(0) … work(count − 1) once each, in no particular order. The calls must not depend
  /// on each other.
  template <class Work>
  void each(int count, const Work& work) {
    if (threads_ <= 1 || count <= 1) {
      for (int i = 0; i < count; ++i) work(i);
    } else {
      share(count, work);
    }
  }

 private:
#ifdef __SANITIZE_THREAD__
  // The packaged TBB is not compiled for the thread sanitizer, which then does not see that TBB
  // hands a piece over and waits for its end. Here each thread has its own pieces and nothing
  // orders them, so that the sanitizer finds every race between two pieces.
  template <class Work>
  void share(int count, const Work& work) {
    std::vector<std::jthread> others;
    const auto pieces = [&](int first) {
      for (int i = first; i < count; i += threads_) work(i);
    };
    for (int thread = 1; thread < threads_; ++thread) others.emplace_back(pieces, thread);
    pieces(0);
  }
#else
  template <class Work>
  void share(int count, const Work& work) {
    arena_.execute([&] { tbb::parallel_for(0, count, work, tbb::simple_partitioner()); });
  }
#endif

  int threads_;
  tbb::task_arena arena_;
};

/// Calls work(begin, end) for consecutive pieces of 0 … count − 1: one piece per thread, or fewer
/// where pieces would be short. The result for an element must not depend on the division.
template <class Work>
void for_chunks(std::ptrdiff_t count, int threads, const Work& work) {
  constexpr std::ptrdiff_t kFewest = 4096;  // a shorter piece is not worth a thread
  const auto pieces =
      static_cast<int>(std::clamp<std::ptrdiff_t>(count / kFewest, 1, std::max(threads, 1)));
  if (pieces == 1) return work(std::ptrdiff_t{0}, count);
  Workers(pieces).each(pieces, [&](std::ptrdiff_t piece) {
    work(count * piece / pieces, count * (piece + 1) / pieces);
  });
}

}  // namespace deformlab
