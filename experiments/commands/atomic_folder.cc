#include "experiments/commands/atomic_folder.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "experiments/commands/manifest.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/core/output_calls.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& folder, const std::string& why) {
  throw InputError(fmt::format("cannot write the folder '{}': {}", folder.string(), why));
}

void check(int error, const fs::path& folder) {
  if (error != 0) fail(folder, std::generic_category().message(error));
}

}  // namespace

AtomicFolder::AtomicFolder(fs::path target, const std::vector<std::string>& names)
    : named_(std::move(target)), target_(followed(named_)) {
  std::error_code error;
  const fs::file_status old = fs::status(target_, error);
  if (!fs::status_known(old)) fail(named_, error.message());
  if (fs::exists(old) && !fs::is_directory(old)) {
    fail(named_, "a file of that name is in the way; move it away, or choose another --out");
  }
  try {
    make_parents();
    lock_.emplace(parent() / hidden("lock"), fmt::format("'{}'", named_.string()));
    clean_up();
    Manifest(target_).check_free(names);
    make_temporary();
  } catch (const fs::filesystem_error& e) {
    fail(named_, e.code().message());
  }
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  try {
    if (!committed_ && !temporary_.empty()) discard(temporary_, target_);
  } catch (const std::exception& e) {
    LOG(WARNING) << e.what() << "; the next run will remove '" << temporary_.string() << "'";
  }
  lock_.reset();
  for (const fs::path& folder : made_) output_calls::remove_folder(folder);  // only empty ones
}

fs::path AtomicFolder::parent() const {
  return target_.has_parent_path() ? target_.parent_path() : fs::path(".");
}

std::string AtomicFolder::hidden(const std::string& ending) const {
  return fmt::format(".{}.deformlab-{}", target_.filename().string(), ending);
}

void AtomicFolder::make_parents() {
  std::error_code error;
  for (fs::path p = parent(); !p.empty() && !fs::exists(p, error); p = p.parent_path()) {
    made_.push_back(p);
  }
  for (auto missing = made_.rbegin(); missing != made_.rend(); ++missing) {
    const int failed = output_calls::make_folder(*missing, 0777);
    if (failed != EEXIST) check(failed, *missing);
  }
}

// Completes or removes what runs that were killed have left. A run that was killed between two
// renames, where the file system cannot exchange folders, may have left the only result.
void AtomicFolder::clean_up() const {
  if (!lock_->excludes_others()) return;
  remove_leftovers(parent());
  std::vector<fs::path> left;
  for (const auto& entry : fs::directory_iterator(parent())) {
    const bool ours = entry.path().filename().string().starts_with(hidden(""));
    if (ours && entry.is_directory() && !entry.is_symlink()) left.push_back(entry.path());
  }
  for (const fs::path& folder : left) {
    if (fs::exists(target_)) {
      if (discard(folder, target_)) continue;
      LOG(WARNING) << "'" << folder.string() << "' holds files that a stopped run could not put "
                   << "back into '" << named_.string() << "'; look at them and delete the folder";
    } else if (Manifest(folder).is_complete()) {
      check(output_calls::rename(folder, target_), named_);
    } else {
      check(output_calls::make_folder(target_, 0777), named_);
      discard(folder, target_);
      output_calls::remove_folder(target_);  // stays if files of others are in it
    }
  }
}

void AtomicFolder::make_temporary() {
  const fs::path path = parent() / unpredictable_name(hidden(""), "");
  check(output_calls::make_folder(path, 0777), named_);
  temporary_ = path;
}

void AtomicFolder::begin(const std::vector<std::string>& names) {
  Manifest(target_).check_free(names);
  write_file(temporary_ / kManifest, Manifest::text(names));
}

void AtomicFolder::commit() {
  try {
    if (fs::exists(target_)) keep_old();
    check(output_calls::sync_folder(temporary_), named_);
    exchange();
    committed_ = true;
    check(output_calls::sync_folder(parent()), named_);
    if (fs::exists(temporary_) && !discard(temporary_, target_)) {
      LOG(WARNING) << "'" << temporary_.string() << "' holds files that came while the run wrote";
    }
    lock_->release();
  } catch (const fs::filesystem_error& e) {
    fail(named_, e.code().message());
  }
}

void AtomicFolder::keep_old() {
  keep_foreign(target_, temporary_);
  const auto mode = static_cast<mode_t>(fs::status(target_).permissions());
  check(output_calls::set_mode(temporary_, mode), named_);
}

// Without an exchange in one step there is a moment in which only hidden folders hold the results.
void AtomicFolder::exchange() {
  if (!fs::exists(target_)) return check(output_calls::rename(temporary_, target_), named_);
  const int error = output_calls::exchange(temporary_, target_);
  const bool lacking = error == ENOSYS || error == EINVAL || error == EOPNOTSUPP;
  if (!lacking) return check(error, named_);
  const fs::path old = parent() / unpredictable_name(hidden(""), "");
  check(output_calls::rename(target_, old), named_);
  if (const int failed = output_calls::rename(temporary_, target_)) {
    output_calls::rename(old, target_);
    check(failed, named_);
  }
  temporary_ = old;
}

}  // namespace deformlab
