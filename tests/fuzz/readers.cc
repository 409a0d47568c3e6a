#include "tests/fuzz/readers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace deformlab::fuzz {
namespace {

namespace fs = std::filesystem;

/// A folder in memory, if there is one, because writers wait until a file is on the disk.
fs::path temporary_folder() {
  const bool in_memory = std::getenv("TMPDIR") == nullptr && fs::is_directory("/dev/shm");
  return in_memory ? "/dev/shm" : fs::temp_directory_path();
}

struct PrivateFolder {
  fs::path path;

  PrivateFolder() {
    std::string name = temporary_folder() / "deformlab-readers-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
    path = name;
  }
  ~PrivateFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
};

}  // namespace

std::vector<Reader> readers() {
  std::vector<Reader> all;
  for (const auto& some : {shape_readers(), drawing_readers(), config_readers(), list_readers()}) {
    std::ranges::copy(some, std::back_inserter(all));
  }
  return all;
}

const fs::path& private_folder() {
  static const PrivateFolder folder;
  return folder.path;
}

fs::path put(const std::string& name, const std::string& bytes) {
  fs::path path = private_folder() / name;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  if (!file.write(bytes.data(), std::ssize(bytes)) || !file.flush()) {
    throw std::runtime_error(fmt::format("cannot write {}", path.string()));
  }
  return path;
}

void expect(bool holds, const char* statement) {
  if (!holds) throw std::logic_error(fmt::format("this does not hold: {}", statement));
}

}  // namespace deformlab::fuzz
