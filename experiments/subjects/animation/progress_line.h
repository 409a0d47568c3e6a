#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace deformlab {

/// Shows the progress of long work on standard error, at most once a second. On a terminal it is
/// one line that is overwritten.
class ProgressLine {
 public:
  explicit ProgressLine(std::string what);  ///< such as "animate: checking frame"
  ~ProgressLine();
  void show(std::int64_t done, std::int64_t all);

 private:
  std::string what_;
  bool terminal_, shown_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace deformlab
