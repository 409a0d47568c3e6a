#include <fmt/format.h>
#include <glog/logging.h>

#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "experiments/commands/results.h"
#include "geometry/core/error.h"
#include "geometry/core/file_lock.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// The first line of the page. It is a comment, which readers of the page do not see.
constexpr const char* kMark =
    "<!-- deformlab writes this page. Without this line, runs leave the page as it is. -->\n";

std::string claim_line(const Json& claim) {
  const Json& value = claim.at("measured");  // JSON has neither NaN nor infinity
  const std::string measured =
      value.is_number() ? fmt::format("{:.4g}", value.get<double>()) : "no number";
  const std::string known = claim.value("known", ""), says = claim.value("says", "");
  std::string line = "| " + claim.value("name", "") + " | " + says + " | " + measured + " | " +
                     claim.value("expected", "") + " | ";
  line += claim.value("holds", false) ? "ok" : "**falls short**";
  return line + (known.empty() ? "" : ": " + known) + " |\n";
}

// The sizes of the runs. A config sets these numbers, so that they need no claim.
std::string sizes_line(const Json& runs) {
  std::string text;
  for (const char* name : {"vertices", "nodes", "handles"}) {
    std::vector<std::string> values;
    for (const Json& run : runs) {
      const double value = run.at("metrics").value(name, -1.0);
      if (value >= 0) values.push_back(fmt::format("{:.0f}", value));
    }
    const bool same = std::set<std::string>(values.begin(), values.end()).size() == 1;
    if (same) values.resize(1);
    if (values.empty()) continue;
    text += fmt::format("{}{} {}", text.empty() ? "Sizes: " : "; ", name, fmt::join(values, ", "));
  }
  return text.empty() ? "" : text + ".\n\n";
}

// Links to the pictures of an image sequence.
std::string sequence_line(const fs::path& folder) {
  std::error_code none;
  std::set<std::string> names;  // sorted
  for (const auto& entry : fs::directory_iterator(folder / "frames", none)) {
    if (entry.path().extension() == ".png") names.insert(entry.path().stem().string());
  }
  if (names.empty()) return "";
  std::string text = "Picture by picture:";
  for (const std::string& name : names) {
    text += " [" + name + "](" + folder.filename().string() + "/frames/" + name + ".png)";
  }
  const std::string movie = folder.filename().string() + "/movie.webp";
  if (fs::exists(folder / "movie.webp", none)) text += fmt::format("; [all of them]({})", movie);
  return text + "\n\n";
}

std::string section(const fs::path& folder) {
  const Json metrics = Json::parse(read_file(folder / "metrics.json"));
  const std::string name = folder.filename().string();
  std::string text = "## " + name + "\n\n" + metrics.value("title", "") + "\n\n";
  const std::string paper = metrics.value("paper", "");
  if (!paper.empty()) text += "> " + paper + "\n\n";
  text += "![" + name + "](" + name + "/picture.png)\n\n" + sequence_line(folder);
  text += sizes_line(metrics.value("runs", Json::array()));
  if (metrics.contains("claims") && !metrics["claims"].empty()) {
    text += "| claim | what it says | measured | expected | result |\n|---|---|---|---|---|\n";
    for (const Json& claim : metrics["claims"]) text += claim_line(claim);
    text += "\n";
  }
  if (fs::exists(folder / "table.md")) text += read_file(folder / "table.md") + "\n";
  return text + "`./deformlab run configs/" + name + ".yaml`\n\n";
}

// A folder whose metrics.json is not ours, or that another run is about to replace, is left out.
std::string section_or_nothing(const fs::path& folder) {
  try {
    return section(folder);
  } catch (const Json::exception&) {
    return "";
  } catch (const InputError&) {
    return "";
  }
}

// Whether nothing is lost if the page is written: there is none, or a run has written it.
bool may_write(const fs::path& page) {
  std::error_code error;
  if (fs::symlink_status(page, error).type() == fs::file_type::not_found) return true;
  if (!fs::is_regular_file(page, error) || fs::file_size(page, error) == 0) return false;
  return read_file(page).starts_with(kMark);
}

}  // namespace

void write_gallery(const fs::path& results) {
  const fs::path page = results / "README.md";
  FileLock lock(results / ".README.md.deformlab-lock", fmt::format("'{}'", page.string()));
  if (!may_write(page)) {
    LOG(WARNING) << "'" << page.string() << "' was not written by deformlab and stays as it is; "
                 << "move it away, and the next run writes the pictures and claims of all results "
                 << "to a page of this name";
    return;
  }
  std::set<fs::path> folders;  // sorted
  for (const auto& entry : fs::directory_iterator(results)) {
    const bool hidden = entry.path().filename().string().starts_with(".");
    std::error_code ignored;
    if (!hidden && fs::exists(entry.path() / "metrics.json", ignored)) folders.insert(entry.path());
  }
  std::string text = kMark;
  text +=
      "# Results\n\n`./deformlab run configs/*.yaml` makes all results and writes this page. The "
      "folder of each picture also holds the config with every default (config.yaml), all "
      "measurements (metrics.json), the steps of the solves (trace*.csv), the pictures of an "
      "animation (frames/, and movie.webp, which plays them), what depends on the machine "
      "(times.json and environment.json), and the "
      "list of these files (manifest.txt).\n\n";
  for (const fs::path& folder : folders) text += section_or_nothing(folder);
  text.pop_back();
  write_file(page, text);
  lock.release();
}

}  // namespace deformlab
