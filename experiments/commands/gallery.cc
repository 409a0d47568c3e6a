#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "experiments/commands/results.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string claim_line(const Json& claim) {
  char measured[32] = "no number";  // JSON has neither NaN nor infinity
  if (claim.at("measured").is_number()) {
    std::snprintf(measured, sizeof measured, "%.4g", claim.at("measured").get<double>());
  }
  const std::string known = claim.value("known", ""), says = claim.value("says", "");
  std::string line = "| " + claim.value("name", "") + " | " + says + " | " + measured + " | " +
                     claim.value("expected", "") + " | ";
  line += claim.value("holds", false) ? "ok" : "**falls short**";
  return line + (known.empty() ? "" : ": " + known) + " |\n";
}

// A link for each picture of an image sequence.
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
  return text + "\n\n";
}

std::string section(const fs::path& folder) {
  const Json metrics = Json::parse(contents(folder / "metrics.json"));
  const std::string name = folder.filename().string();
  std::string text = "## " + name + "\n\n" + metrics.value("title", "") + "\n\n";
  const std::string paper = metrics.value("paper", "");
  if (!paper.empty()) text += "> " + paper + "\n\n";
  text += "![" + name + "](" + name + "/picture.png)\n\n" + sequence_line(folder);
  if (metrics.contains("claims") && !metrics["claims"].empty()) {
    text += "| claim | it says | measured | expected | |\n|---|---|---|---|---|\n";
    for (const Json& claim : metrics["claims"]) text += claim_line(claim);
    text += "\n";
  }
  if (fs::exists(folder / "table.md")) text += contents(folder / "table.md") + "\n";
  return text + "`./deformlab run configs/" + name + ".yaml`\n\n";
}

// A folder of somebody else's is no part of the gallery.
std::string section_or_nothing(const fs::path& folder) {
  try {
    return section(folder);
  } catch (const Json::exception&) {
    return "";
  }
}

}  // namespace

void write_gallery(const fs::path& results) {
  std::set<fs::path> folders;  // sorted
  for (const auto& entry : fs::directory_iterator(results)) {
    const bool hidden = entry.path().filename().string().starts_with(".");
    std::error_code ignored;
    if (!hidden && fs::exists(entry.path() / "metrics.json", ignored)) folders.insert(entry.path());
  }
  std::string text =
      "# Results\n\nMade by `./deformlab run configs/*.yaml`, which rewrites this page. Beside "
      "each "
      "picture lie the config with every default (config.yaml), all measurements (metrics.json), "
      "the solves step by step (trace*.csv), an animation's pictures one by one (frames/), and "
      "what depends on the machine: times.json and "
      "environment.json.\n\n";
  for (const fs::path& folder : folders) text += section_or_nothing(folder);
  text.pop_back();
  write_file(results / "README.md", text);
}

}  // namespace deformlab
