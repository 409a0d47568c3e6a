#include "experiments/subjects/shape/edit.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>

#include "experiments/config/config.h"
#include "experiments/config/suggest.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

/// Reads a file with one index in each line. Blank lines are skipped.
std::vector<int> read_indices(const std::filesystem::path& path, const std::string& where) {
  std::istringstream file;
  try {
    file.str(read_file(path));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", where, error.what()));
  }
  std::vector<int> indices;
  std::string text;
  for (int line = 1; std::getline(file, text); ++line) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string::npos) continue;
    const char* end = text.data() + text.find_last_not_of(" \t\r") + 1;
    const auto [last, error] = std::from_chars(text.data() + begin, end, indices.emplace_back());
    if (error != std::errc() || last != end) {
      throw InputError(fmt::format("expected a vertex index (line {} of {}), found {}", line,
                                   path.string(), quote(text)));
    }
  }
  return indices;
}

void check_action(const EditEntry& entry) {
  check_only_true(entry.fix, "fix", entry.where);
  const bool motion = entry.by.has_value() || entry.rotate.has_value();
  const int given = entry.fix.has_value() + entry.to.has_value() + motion;
  if (given != 1) {
    throw InputError(entry.where + ": needs exactly one of fix, by, to, rotate (or rotate and by)" +
                     (given == 0 ? "; found none" : "; found several"));
  }
  if (entry.rotate && entry.rotate->axis.stableNorm() == 0) {
    throw InputError(entry.where + ": the rotation's axis must not be [0, 0, 0]");
  }
}

/// The keys of an edit file.
struct EditFile {
  ConfigNode edit;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("edit", o.edit, "Selections and what happens to them");
  }
};

}  // namespace

std::vector<EditEntry> read_edit(const ConfigNode& list) {
  check_list(list, "edit");
  std::vector<EditEntry> entries;
  read_value(list, "edit", entries);
  if (entries.empty()) throw InputError("'edit' has no entries (" + list.where() + ")");
  for (std::size_t e = 0; e < entries.size(); ++e) {
    EditEntry& entry = entries[e];
    const ConfigNode& node = list.children[e];
    entry.where = fmt::format("edit entry {} ({})", e + 1, node.where());
    check_selection(entry.select, entry.where);
    check_action(entry);
    if (!entry.select.file) continue;
    const ConfigNode& file = *node.find("select")->find("file");
    entry.select.vertices = read_indices(file.folder() / *entry.select.file, entry.where);
    entry.select.file.reset();
  }
  return entries;
}

void put_edit(const std::filesystem::path& path, ConfigNode& root) {
  root.children.push_back(read_config<EditFile>(load_config(path)).edit);
}

}  // namespace deformlab
