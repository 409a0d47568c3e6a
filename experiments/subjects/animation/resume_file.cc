#include "experiments/subjects/animation/resume_file.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <sstream>
#include <utility>

#include "experiments/subjects/animation/fingerprint.h"
#include "geometry/core/files.h"
#include "geometry/core/output_calls.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHead =
    "deformlab animate was stopped: the next run goes on after these frames. Delete this file to "
    "start over.";

// The text without a last line that was not finished.
std::string_view whole_lines(std::string_view text) {
  return text.substr(0, text.rfind('\n') + 1);  // npos + 1 is 0
}

}  // namespace

ResumeFile::ResumeFile(const FramePattern& out, std::string fingerprint)
    : out_(out), path_(out.text() + kProgressEnding), fingerprint_(std::move(fingerprint)) {
  file_.emplace(path_, fmt::format("'{}'", out.text()), O_RDWR | O_APPEND);
  if (fs::file_size(path_) == 0) {
    begin();
  } else {
    go_on(read_file(path_));
  }
}

void ResumeFile::go_on(const std::string& text) {
  const std::string_view whole = whole_lines(text);
  read(whole);
  if (outdated_) return begin();
  if (whole.size() == text.size()) return;
  const int error = output_calls::truncate(file_->descriptor(), std::ssize(whole));
  if (error != 0) cannot_write(path_, error);
}

// A file that holds no frame is of no use.
ResumeFile::~ResumeFile() {
  if (!done_ && !frames_.empty()) file_->keep_file();
}

void ResumeFile::remove() {
  file_->release();
  done_ = true;
}

void ResumeFile::read(std::string_view text) {
  std::istringstream file{std::string(text)};
  std::string head, label, fingerprint;
  std::getline(file, head);
  file >> label >> fingerprint;
  outdated_ = !file || head != kHead || fingerprint != fingerprint_;
  FrameNumber frame = 0;
  Written written;
  while (!outdated_ && file >> label >> frame >> written.size >> written.hash) {
    frames_[frame] = written;
  }
}

void ResumeFile::begin() {
  frames_.clear();
  if (const int error = output_calls::truncate(file_->descriptor(), 0)) cannot_write(path_, error);
  append(fmt::format("{}\nfingerprint {}\n", kHead, fingerprint_));
}

void ResumeFile::append(const std::string& text) {
  if (const int error = output_calls::write(file_->descriptor(), text)) cannot_write(path_, error);
}

ResumeFile::Written ResumeFile::written(FrameNumber frame) const {
  const std::string bytes = read_file(out_.path(frame));
  Fingerprint hash;
  hash.add(bytes);
  return {bytes.size(), hash.text()};
}

bool ResumeFile::has(FrameNumber frame) const {
  const auto found = frames_.find(frame);
  std::error_code error;
  const fs::path path = out_.path(frame);
  if (found == frames_.end() || !fs::is_regular_file(path, error)) return false;
  if (fs::file_size(path, error) != found->second.size || found->second.size == 0) return false;
  return written(frame).hash == found->second.hash;
}

// A line need not be on the disk when the run goes on: the size and the hash tell whether the frame
// is there, and a line that is lost costs one frame.
void ResumeFile::finished(FrameNumber frame) {
  const Written file = written(frame);
  frames_[frame] = file;
  append(fmt::format("frame {} {} {}\n", frame, file.size, file.hash));
}

}  // namespace deformlab
