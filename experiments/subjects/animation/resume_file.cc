#include "experiments/subjects/animation/resume_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "geometry/core/files.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHead =
    "deformlab animate was stopped: the next run goes on after this frame. Delete this file to "
    "start over.";

// Whether a write that was stopped left this file. Its name is that of the complete file, with an
// ending and the id of a process.
bool is_leftover(const std::string& name, const std::string& of) {
  for (const char* ending : {".tmp", ".partial"}) {
    if (!name.starts_with(of + ending)) continue;
    const std::string number = name.substr(of.size() + std::string(ending).size());
    return !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
  }
  return false;
}

void remove_leftovers(const fs::path& folder, const std::vector<std::string>& of) {
  std::error_code error;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (std::ranges::any_of(of, [&](const std::string& f) { return is_leftover(name, f); })) {
      found.push_back(entry.path());
    }
  }
  for (const fs::path& file : found) fs::remove(file, error);
}

}  // namespace

ResumeFile::ResumeFile(const FramePattern& out, std::string fingerprint)
    : out_(out), path_(out.text() + kProgressEnding), fingerprint_(std::move(fingerprint)) {
  read();
}

void ResumeFile::read() {
  std::error_code ignored;
  if (!fs::is_regular_file(path_, ignored)) return;
  std::istringstream file(read_file(path_));
  std::string head, label, fingerprint;
  int last = 0;
  std::getline(file, head);
  file >> label >> last >> label >> fingerprint;
  outdated_ = !file || head != kHead || fingerprint != fingerprint_;
  if (!outdated_) last_ = last;
  if (!file) return;
  remove_leftovers(out_.folder(), {path_.filename().string(), out_.path(last).filename().string(),
                                   out_.path(last + 1).filename().string()});
}

bool ResumeFile::has(int frame) const {
  std::error_code ignored;
  return last_ && frame <= *last_ && fs::is_regular_file(out_.path(frame), ignored);
}

void ResumeFile::finished(int frame) {
  last_ = std::max(last_.value_or(frame), frame);
  write_file(path_, fmt::format("{}\nframe {}\nfingerprint {}\n", kHead, *last_, fingerprint_));
}

void ResumeFile::remove() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

}  // namespace deformlab
