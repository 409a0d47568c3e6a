#include "experiments/commands/atomic_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "geometry/core/error.h"

namespace deformlab {

namespace fs = std::filesystem;

AtomicFolder::AtomicFolder(fs::path target, IsOurs is_ours)
    : target_(std::move(target)), is_ours_(is_ours) {
  std::error_code error;
  for (fs::path p = target_.parent_path(); !p.empty() && !fs::exists(p, error);) {
    made_.push_back(p);
    p = p.parent_path();
  }
  fs::create_directories(target_.parent_path().empty() ? "." : target_.parent_path(), error);
  const bool taken = !error && fs::exists(target_, error) && !fs::is_directory(target_, error);
  temporary_ =
      target_.parent_path() / fmt::format(".{}.partial{}", target_.filename().string(), getpid());
  if (!error && !taken) fs::create_directory(temporary_, error);
  if (!error && !taken) return;
  throw InputError(fmt::format("cannot write the folder '{}': {}", target_.string(),
                               taken ? "a file of that name is in the way" : error.message()));
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
  for (const fs::path& folder : made_) fs::remove(folder, ignored);  // removes only empty ones
}

void AtomicFolder::commit() {
  try {
    const fs::path old = temporary_.string() + ".old";
    if (fs::exists(target_)) {
      for (const auto& entry : fs::directory_iterator(target_)) {  // keeps the files of others
        const fs::path name = entry.path().filename();
        if (fs::exists(temporary_ / name) || is_ours_(name)) continue;
        fs::copy(entry.path(), temporary_ / name, fs::copy_options::recursive);
      }
      fs::rename(target_, old);
    }
    fs::rename(temporary_, target_);
    fs::remove_all(old);
  } catch (const fs::filesystem_error& e) {
    throw InputError(
        fmt::format("cannot write the folder '{}': {}", target_.string(), e.code().message()));
  }
}

}  // namespace deformlab
