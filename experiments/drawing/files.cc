#include "experiments/drawing/files.h"

#include <cctype>
#include <fstream>

#include "geometry/error.h"

namespace deformlab {

namespace fs = std::filesystem;

void cannot_read(const fs::path& path, const std::string& what) {
  throw InputError("cannot read '" + path.string() + "': " + what);
}

std::string read_bytes(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (!fs::exists(status)) cannot_read(path, "no such file");
  if (!fs::is_regular_file(status)) cannot_read(path, "it is not a file");
  std::ifstream in(path, std::ios::binary);
  std::string bytes(fs::file_size(path, ignored), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) cannot_read(path, "it could not be read to its end");
  if (bytes.empty()) cannot_read(path, "it is empty");
  return bytes;
}

std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace deformlab
