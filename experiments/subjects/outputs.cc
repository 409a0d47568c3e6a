#include "experiments/subjects/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

void check_output(const Output& output) {
  const auto& [file, flag] = output;
  if (file.empty()) return;
  const std::string cannot = fmt::format("cannot write '{}' ({}): ", file, flag);
  const fs::path folder = fs::path(file).parent_path();
  std::error_code error;
  if (!fs::is_directory(folder.empty() ? "." : folder, error)) {
    throw InputError(
        fmt::format("{}there is no folder '{}'; make it first", cannot, folder.string()));
  }
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    throw InputError(fmt::format("{}it is a folder or a device; name a file", cannot));
  }
  remove_leftovers(folder.empty() ? "." : folder);
  try {
    AtomicFile(file).discard();
  } catch (const InputError& e) {
    const std::string without_flag = fmt::format("cannot write '{}': ", file), what = e.what();
    throw InputError(cannot + what.substr(std::min(without_flag.size(), what.size())));
  }
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  const fs::path first = fs::weakly_canonical(a, ignored);
  return !first.empty() && first == fs::weakly_canonical(b, ignored);
}

}  // namespace

void check_outputs(const std::vector<std::string>& inputs, const std::vector<Output>& outputs) {
  std::vector<std::string> files = inputs;
  for (const Output& output : outputs) {
    check_output(output);
    files.push_back(output.path);
  }
  for (std::size_t written = inputs.size(); written < files.size(); ++written) {
    for (std::size_t other = 0; other < written; ++other) {
      const bool in_place = written == inputs.size() && other == 0;
      const bool same = same_file(files[written], files[other]);
      if (in_place || files[written].empty() || !same) continue;
      throw InputError(
          fmt::format("'{}' is named twice, by two of the input, --edit, --out, --metrics and "
                      "--picture; only the input and --out may be one file",
                      files[written]));
    }
  }
}

void check_picture_name(const std::string& path) {
  if (path.empty() || fs::path(path).extension() == ".png") return;
  throw InputError(fmt::format("--picture '{}': a picture's name must end in .png", path));
}

}  // namespace deformlab
