#include "experiments/subjects/animation/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace deformlab {

using std::chrono::steady_clock;

ProgressLine::ProgressLine(std::string what)
    : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) != 0), next_(steady_clock::now()) {}

ProgressLine::~ProgressLine() {
  if (terminal_ && shown_) std::fputc('\n', stderr);
}

void ProgressLine::show(std::int64_t done, std::int64_t all) {
  if (steady_clock::now() < next_ && done != all) return;
  next_ = steady_clock::now() + std::chrono::seconds(1);
  const char *begin = terminal_ ? "\r" : "", *end = terminal_ ? "" : "\n";
  std::fputs(fmt::format("{}{} {} of {}{}", begin, what_, done, all, end).c_str(), stderr);
  shown_ = true;
}

}  // namespace deformlab
