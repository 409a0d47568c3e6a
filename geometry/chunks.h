#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

namespace deformlab {

/// Calls work(begin, end) for consecutive pieces of 0 … count − 1, one a thread. The pieces must
/// not depend on each other; work must not throw.
template <class Work>
void for_chunks(std::ptrdiff_t count, int threads, Work&& work) {
  constexpr std::ptrdiff_t kFewest = 4096;  // not worth a thread
  const std::ptrdiff_t pieces =
      std::clamp<std::ptrdiff_t>(count / kFewest, 1, std::max(threads, 1));
  std::vector<std::jthread> others;
  for (std::ptrdiff_t t = 1; t < pieces; ++t) {
    others.emplace_back(
        [&work, t, count, pieces] { work(count * t / pieces, count * (t + 1) / pieces); });
  }
  work(0, count / pieces);
}

}  // namespace deformlab
