#include "geometry/core/files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "geometry/core/error.h"
#include "geometry/core/text.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

}  // namespace

void cannot_read(const fs::path& path, const std::string& what) {
  throw InputError("cannot read '" + path.string() + "': " + what);
}

void cannot_write(const fs::path& path, const std::string& what) {
  throw InputError("cannot write '" + path.string() + "': " + what);
}

std::string read_file(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (!fs::exists(status)) cannot_read(path, "no such file");
  if (fs::is_directory(status)) cannot_read(path, "it is a folder");
  if (!fs::is_regular_file(status)) cannot_read(path, "it is not a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) cannot_read(path, std::strerror(errno));
  std::string bytes(fs::file_size(path, ignored), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) cannot_read(path, "it could not be read to its end");
  if (bytes.empty()) cannot_read(path, "it is empty");
  return bytes;
}

std::string extension_of(const fs::path& path) { return lower_case(path.extension().string()); }

AtomicFile::AtomicFile(fs::path out) : out_(std::move(out)) {
  std::error_code error;
  target_ = fs::exists(out_, error) ? fs::canonical(out_, error) : out_;
  const fs::path folder = folder_of(target_);
  if (!fs::is_directory(folder, error)) {
    cannot_write(out_, "there is no folder '" + folder.string() + "'; make it first");
  }
  if (fs::exists(target_, error) && !fs::is_regular_file(target_, error)) {
    cannot_write(out_, "it exists and is not a file");
  }
  temporary_ = folder / (target_.filename().string() + ".partial" + std::to_string(::getpid()));
  file_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!file_) cannot_write(out_, "folder '" + folder.string() + "': " + std::strerror(errno));
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::write(std::string_view bytes) {
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void AtomicFile::commit() {
  file_.close();
  if (!file_) {
    cannot_write(out_, "folder '" + folder_of(target_).string() + "': the disk may be full");
  }
  std::error_code error;
  if (fs::exists(target_, error)) {
    fs::permissions(temporary_, fs::status(target_).permissions(), error);
  }
  error.clear();
  fs::rename(temporary_, target_, error);
  if (error) {
    cannot_write(out_, "folder '" + folder_of(target_).string() + "': " + error.message());
  }
  temporary_.clear();
}

void write_file(const fs::path& out, std::string_view bytes) {
  AtomicFile file(out);
  file.write(bytes);
  file.commit();
}

}  // namespace deformlab
