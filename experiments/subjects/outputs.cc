#include "experiments/subjects/outputs.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "experiments/config/config_node.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

void check_output(const NamedFile& output) {
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

// The same for all paths of one file: its number where it exists, and its full path elsewhere.
std::string identity(const std::string& path) {
  struct stat file = {};
  if (::stat(path.c_str(), &file) == 0) return fmt::format("{}:{}", file.st_dev, file.st_ino);
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(path, ignored), ignored).string();
}

std::string text_of(const NamedFile& file) { return fmt::format("{} '{}'", file.name, file.path); }

// The shape of a config may also be in the working folder.
void add_file(const ConfigNode& node, std::vector<NamedFile>& files) {
  std::error_code ignored;
  for (const fs::path& path : {node.folder() / node.text, fs::path(node.text)}) {
    if (!fs::exists(path, ignored)) continue;
    files.push_back({path.string(), fmt::format("the file ({})", node.where())});
    return;
  }
}

void add_files(const ConfigNode& node, std::vector<NamedFile>& files) {
  constexpr std::array kFiles{"file", "targets", "mask", "cursor", "performance"};
  const bool is_file = std::ranges::find(kFiles, node.key) != kFiles.end();
  if (is_file && node.kind == ConfigNode::Kind::kScalar) add_file(node, files);
  for (const ConfigNode& child : node.children) add_files(child, files);
}

}  // namespace

std::vector<NamedFile> files_in(const ConfigNode& config) {
  std::vector<NamedFile> files;
  add_files(config, files);
  return files;
}

void check_distinct(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  std::map<std::string, std::string> known;
  for (const NamedFile& input : inputs) {
    if (input.path.empty()) continue;
    known.emplace(identity(input.path), text_of(input) + ", which the run reads");
  }
  for (const NamedFile& output : outputs) {
    if (output.path.empty()) continue;
    const auto [first, is_new] = known.emplace(identity(output.path), text_of(output));
    if (is_new) continue;
    throw InputError(fmt::format("{} would replace {}; choose another name or folder for it",
                                 text_of(output), first->second));
  }
}

void check_outputs(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  for (const NamedFile& output : outputs) check_output(output);
  check_distinct(inputs, outputs);
}

void check_picture_name(const std::string& path) {
  if (path.empty() || fs::path(path).extension() == ".png") return;
  throw InputError(fmt::format("--picture '{}': a picture's name must end in .png", path));
}

}  // namespace deformlab
