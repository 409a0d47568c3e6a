#pragma once

#include <chrono>
#include <string>

namespace deformlab {

/// Tells on standard error how far a long work has come, at most once a second: on a terminal in
/// one line that is written over.
class ProgressLine {
 public:
  explicit ProgressLine(std::string what);  ///< "animate: checking frame"
  ~ProgressLine();
  void show(int done, int all);

 private:
  std::string what_;
  bool terminal_, shown_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace deformlab
