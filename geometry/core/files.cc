#include "geometry/core/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <random>
#include <system_error>
#include <utility>
#include <vector>

#include "geometry/core/error.h"
#include "geometry/core/output_calls.h"
#include "geometry/core/text.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

constexpr const char *kBegin = ".deformlab-", *kEnd = ".partial";
constexpr std::size_t kDigits = 16;
constexpr std::size_t kBuffer = std::size_t{1} << 20;
constexpr int kMostLinks = 40;  // as many as Linux follows

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Closes a file.
struct Descriptor {
  int number = -1;
  explicit Descriptor(int opened) : number(opened) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

mode_t mode_of(fs::perms permissions) { return static_cast<mode_t>(permissions); }

}  // namespace

void cannot_read(const fs::path& path, const std::string& what) {
  throw InputError("cannot read '" + path.string() + "': " + what);
}

void cannot_write(const fs::path& path, const std::string& what) {
  throw InputError("cannot write '" + path.string() + "': " + what);
}

void cannot_write(const fs::path& path, int error) {
  cannot_write(path, std::generic_category().message(error));
}

void check_readable(const fs::path& path, bool pipe_too) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::status_known(status)) cannot_read(path, error.message());
  if (!fs::exists(status)) cannot_read(path, "no such file");
  if (fs::is_directory(status)) cannot_read(path, "it is a folder");
  if (fs::is_regular_file(status) || (pipe_too && fs::is_fifo(status))) return;
  const char* kind = fs::is_fifo(status) ? "pipe" : fs::is_socket(status) ? "socket" : "device";
  cannot_read(path, std::string("it is a ") + kind + "; name a file");
}

std::string read_file(const fs::path& path) {
  check_readable(path);
  const Descriptor in{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
  struct stat file = {};
  if (in.number < 0 || ::fstat(in.number, &file) != 0) cannot_read(path, std::strerror(errno));
  std::string bytes(static_cast<std::size_t>(file.st_size), '\0');
  std::size_t size = 0;
  while (size < bytes.size()) {
    const ssize_t more = ::read(in.number, bytes.data() + size, bytes.size() - size);
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) cannot_read(path, std::strerror(errno));
    if (more == 0) cannot_read(path, "it became shorter while it was read");
    size += static_cast<std::size_t>(more);
  }
  if (bytes.empty()) cannot_read(path, "it is empty");
  return bytes;
}

std::string extension_of(const fs::path& path) { return lower_case(path.extension().string()); }

std::string unpredictable_name(const std::string& begin, const std::string& end) {
  static constexpr char kHexadecimal[] = "0123456789abcdef";
  std::random_device random;
  std::string name = begin;
  for (std::size_t i = 0; i < kDigits; ++i) name += kHexadecimal[random() % 16];
  return name + end;
}

fs::path followed(fs::path path) {
  std::error_code error;
  for (int links = 0; links < kMostLinks && fs::is_symlink(path, error); ++links) {
    const fs::path to = fs::read_symlink(path, error);
    path = to.is_absolute() ? to : path.parent_path() / to;
  }
  return path;
}

bool is_temporary(const std::string& name) {
  const std::size_t begin = std::strlen(kBegin), size = begin + kDigits + std::strlen(kEnd);
  return name.size() == size && name.starts_with(kBegin) && name.ends_with(kEnd) &&
         name.find_first_not_of("0123456789abcdef", begin) == begin + kDigits;
}

void remove_leftovers(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (is_temporary(entry.path().filename().string())) found.push_back(entry.path());
  }
  for (const fs::path& path : found) {
    const Descriptor file{::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
    const bool is_free = file.number >= 0 && ::flock(file.number, LOCK_EX | LOCK_NB) == 0;
    if (is_free) output_calls::remove_file(path);
  }
}

AtomicFile::AtomicFile(fs::path out) : out_(std::move(out)), target_(followed(out_)) {
  check_target();
  make_temporary();
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) output_calls::remove_file(temporary_);
  if (descriptor_ >= 0) ::close(descriptor_);
}

void AtomicFile::check_target() {
  std::error_code error;
  const fs::path folder = folder_of(target_);
  const fs::file_status old = fs::status(target_, error);
  if (!fs::status_known(old)) cannot_write(out_, error.message());
  if (!fs::is_directory(folder, error)) {
    cannot_write(out_, "there is no folder '" + folder.string() + "'; make it first");
  }
  if (!fs::exists(old)) return;
  if (!fs::is_regular_file(old)) cannot_write(out_, "it exists and is not a file");
  old_mode_ = old.permissions();
}

// The lock tells other processes that this one still writes. Another process may have removed the
// file before it was locked; then a new one is made.
void AtomicFile::make_temporary() {
  const mode_t mode = old_mode_ == fs::perms::unknown ? 0666 : mode_of(old_mode_) & 0777;
  struct stat file = {};
  do {
    if (descriptor_ >= 0) ::close(descriptor_);
    const fs::path path = folder_of(target_) / unpredictable_name(kBegin, kEnd);
    if (const int error = output_calls::create(path, mode, descriptor_)) fail(error);
    temporary_ = path;
    ::flock(descriptor_, LOCK_EX | LOCK_NB);
  } while (::fstat(descriptor_, &file) == 0 && file.st_nlink == 0);
}

void AtomicFile::fail(int error) const {
  cannot_write(out_, "folder '" + folder_of(target_).string() +
                         "': " + std::generic_category().message(error));
}

void AtomicFile::write(std::string_view bytes) {
  if (buffer_.size() + bytes.size() >= kBuffer) flush();
  if (bytes.size() < kBuffer) {
    buffer_ += bytes;
  } else if (const int error = output_calls::write(descriptor_, bytes)) {
    fail(error);
  }
}

void AtomicFile::flush() {
  if (const int error = output_calls::write(descriptor_, buffer_)) fail(error);
  buffer_.clear();
}

void AtomicFile::commit() {
  flush();
  int error = 0;
  if (old_mode_ != fs::perms::unknown) {
    error = output_calls::set_mode(descriptor_, mode_of(old_mode_));
  }
  if (error == 0) error = output_calls::sync(descriptor_);
  if (error == 0) error = output_calls::rename(temporary_, target_);
  if (error != 0) fail(error);
  temporary_.clear();
  if (const int unsynced = output_calls::sync_folder(folder_of(target_))) fail(unsynced);
}

void AtomicFile::discard() {
  if (const int error = output_calls::remove_file(temporary_)) fail(error);
  temporary_.clear();
}

void write_file(const fs::path& out, std::string_view bytes) {
  AtomicFile file(out);
  file.write(bytes);
  file.commit();
}

}  // namespace deformlab
