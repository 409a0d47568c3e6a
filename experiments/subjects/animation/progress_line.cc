#include "experiments/subjects/animation/progress_line.h"

#include <unistd.h>

#include <cstdio>

namespace deformlab {

using std::chrono::steady_clock;

ProgressLine::ProgressLine(std::string what)
    : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) != 0), next_(steady_clock::now()) {}

ProgressLine::~ProgressLine() {
  if (terminal_ && shown_) std::fputc('\n', stderr);
}

void ProgressLine::show(int done, int all) {
  if (steady_clock::now() < next_ && done != all) return;
  next_ = steady_clock::now() + std::chrono::seconds(1);
  std::fprintf(stderr, terminal_ ? "\r%s %d of %d" : "%s %d of %d\n", what_.c_str(), done, all);
  shown_ = true;
}

}  // namespace deformlab
