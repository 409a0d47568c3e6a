#include "experiments/commands/manifest.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <sstream>

#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/core/output_calls.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHead =
    "deformlab has written these files. Its next run into this folder replaces them, and leaves "
    "all "
    "others.";

mode_t mode_of(const fs::path& path) {
  return static_cast<mode_t>(fs::symlink_status(path).permissions());
}

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type() != fs::file_type::not_found;
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type() == fs::file_type::directory;
}

bool are_one_file(const fs::path& a, const fs::path& b) {
  struct stat first = {}, second = {};
  return ::lstat(a.c_str(), &first) == 0 && ::lstat(b.c_str(), &second) == 0 &&
         first.st_ino == second.st_ino && first.st_dev == second.st_dev;
}

void check(int error, const fs::path& path) {
  if (error != 0) cannot_write(path, error);
}

std::vector<fs::path> names_in(const fs::path& folder) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename());
  }
  return names;
}

/// Moves the files of others from an old folder of results to a new one.
class Mover {
 public:
  Mover(const fs::path& old, const fs::path& now) : old_(old), now_(now), listed_(old) {}

  // Makes a folder in the new one. It gets the permissions of the old one when it is complete.
  void make_folder(const fs::path& name) const {
    if (is_folder(now_ / name)) return;
    if (name.has_parent_path()) make_folder(name.parent_path());
    check(output_calls::make_folder(now_ / name, 0700), now_ / name);
  }

  void link_all(const fs::path& folder) const {
    const std::vector<fs::path> names = names_in(old_ / folder);
    bool only_listed = !names.empty();
    for (const fs::path& leaf : names) {
      const fs::path name = folder / leaf;
      if (is_folder(old_ / name)) {
        link_all(name);
      } else if (listed_.lists(name)) {
        if (is_there(now_ / name)) copy_mode(name);
        continue;
      } else if (!is_temporary(leaf.string())) {
        link(name);
      }
      only_listed = false;
    }
    if (!only_listed && !folder.empty()) make_folder(folder);
    if (!folder.empty() && is_folder(now_ / folder)) copy_mode(folder);
  }

  // The manifest goes last, so that a run that was killed here can be followed by another.
  bool discard(const fs::path& folder) const {
    bool empty = true;
    for (const fs::path& leaf : names_in(old_ / folder)) {
      const fs::path name = folder / leaf;
      if (name != kManifest || !listed_.lists(name)) empty = discard_one(name) && empty;
    }
    if (folder.empty() && empty && listed_.lists(kManifest)) {
      check(output_calls::remove_file(old_ / kManifest), old_ / kManifest);
    }
    if (empty) check(output_calls::remove_folder(old_ / folder), old_ / folder);
    return empty;
  }

 private:
  void copy_mode(const fs::path& name) const {
    if (mode_of(old_ / name) == mode_of(now_ / name)) return;
    check(output_calls::set_mode(now_ / name, mode_of(old_ / name)), now_ / name);
  }

  // Where a file system or its rules admit no second name, `discard` moves the file later.
  void link(const fs::path& name) const {
    if (is_there(now_ / name)) {
      cannot_write(name, "a file of that name, which no run has written, is in the way; move it");
    }
    if (name.has_parent_path()) make_folder(name.parent_path());
    const int error = output_calls::link(old_ / name, now_ / name);
    const bool is_admitted = error != EPERM && error != EOPNOTSUPP && error != EXDEV &&
                             error != EMLINK && error != ENOSYS && error != EACCES;
    if (is_admitted) check(error, now_ / name);
  }

  bool discard_one(const fs::path& name) const {
    const fs::path from = old_ / name, to = now_ / name;
    const bool folder = is_folder(from);
    if (folder && is_folder(to)) return discard(name);
    if (folder && has_only_listed(name)) return discard(name);
    const bool is_ours = !folder && (listed_.lists(name) || is_temporary(name.filename().string()));
    if (is_ours || are_one_file(from, to)) {
      check(output_calls::remove_file(from), from);
      return true;
    }
    if (is_there(to)) return false;
    check(output_calls::rename(from, to), from);
    return true;
  }

  bool has_only_listed(const fs::path& folder) const {
    for (const fs::path& leaf : names_in(old_ / folder)) {
      if (!listed_.lists(folder / leaf) && !is_temporary(leaf.string())) return false;
    }
    return true;
  }

  const fs::path &old_, &now_;
  Manifest listed_;
};

}  // namespace

Manifest::Manifest(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  const fs::path path = folder_ / kManifest;
  if (fs::symlink_status(path, error).type() != fs::file_type::regular) return;
  if (fs::file_size(path, error) == 0) return;
  std::istringstream text(read_file(path));
  std::string line;
  if (!std::getline(text, line) || line != kHead) return;
  names_.insert(kManifest);
  while (std::getline(text, line)) names_.insert(line);
}

bool Manifest::lists(const fs::path& name) const {
  std::error_code error;
  const bool is_file = fs::symlink_status(folder_ / name, error).type() == fs::file_type::regular;
  return is_file && names_.contains(name.string());
}

bool Manifest::is_complete() const {
  return !names_.empty() &&
         std::ranges::all_of(names_, [this](const std::string& name) { return lists(name); });
}

void Manifest::check_free(std::vector<std::string> names) const {
  names.emplace_back(kManifest);
  for (const std::string& name : names) {
    const fs::path parent = fs::path(name).parent_path();
    const bool blocked =
        !parent.empty() && is_there(folder_ / parent) && !is_folder(folder_ / parent);
    const fs::path path = folder_ / (blocked ? parent : fs::path(name));
    if (!blocked && (!is_there(path) || lists(name))) continue;
    throw InputError(fmt::format(
        "cannot write '{}': no run of deformlab has written the file or folder that has this name; "
        "move it away, or choose another --out",
        path.string()));
  }
}

std::string Manifest::text(const std::vector<std::string>& names) {
  return fmt::format("{}\n{}\n", kHead, fmt::join(names, "\n"));
}

void keep_foreign(const fs::path& old, const fs::path& fresh) { Mover(old, fresh).link_all(""); }

bool discard(const fs::path& old, const fs::path& now) { return Mover(old, now).discard(""); }

}  // namespace deformlab
