#include "experiments/commands/results.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "experiments/commands/environment.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFrames = "frames";

// Columns of a sweep's table, beside the keys that it sweeps.
constexpr const char* kTableMetrics[] = {"iterations",          "converged", "cost",
                                         "handle_rms_relative", "min_det_R", "shear_mean",
                                         "stretch_max"};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

Json json(const Metrics& metrics) {
  Json object = Json::object();
  for (const auto& [name, value] : metrics) object[name] = value;
  return object;
}

Json settings(const MeasuredRun& run) {
  Json object = Json::object();
  for (const auto& [key, value] : run.settings) object[key] = value;
  return object;
}

Json solver_json(const Summary& s) {
  return {{"method", s.method},
          {"linear_solver", s.linear_solver},
          {"globalization", s.globalization},
          {"status", to_string(s.status)},
          {"message", s.message}};
}

// The same beside metrics, where its method goes by the name of the solver.
Json flat_solver_json(const Summary& s) {
  Json document{{"solver", s.method}};
  document.update(solver_json(s));
  document.erase("method");
  return document;
}

// All but costs, and counts as whole numbers.
void add_metrics(const Metrics& metrics, Json& document) {
  for (const auto& [name, value] : metrics) {
    if (!name.starts_with("cost")) document[name] = value;
  }
  for (const char* count : {"nodes", "edges", "unknowns", "iterations", "factorizations",
                            "inside_out", "frames", "solves", "handles"}) {
    if (document.contains(count)) document[count] = document[count].get<long>();
  }
}

void add_circumstances(const Summary& solve, const std::vector<std::string>& notes,
                       Json& document) {
  document["blas"] = solve.blas;
  document["threads"] = solve.threads;
  document["notes"] = notes;
  document["environment"] = Json(environment());
}

std::string metrics_json(const Outcome& outcome) {
  Json document{{"title", outcome.config.title}, {"paper", outcome.config.paper}};
  document["claims"] = Json::array();
  for (const ClaimResult& claim : outcome.claims) {
    document["claims"].push_back({{"name", claim.name},
                                  {"says", claim.says},
                                  {"expected", claim.expected},
                                  {"measured", claim.measured},
                                  {"holds", claim.holds},
                                  {"known", claim.known}});
  }
  document["runs"] = Json::array();
  for (const Run& run : outcome.runs) {
    document["runs"].push_back({{"settings", settings(run.measured)},
                                {"solver", solver_json(run.solve)},
                                {"metrics", json(run.measured.metrics)},
                                {"notes", run.notes}});
  }
  return document.dump(1) + "\n";
}

std::string times_json(const Outcome& outcome) {
  Json document = Json::array();
  for (const Run& run : outcome.runs) {
    Json iterations = Json::array();
    for (const Iteration& i : run.solve.iterations) iterations.push_back(i.seconds);
    document.push_back({{"settings", settings(run.measured)},
                        {"seconds", json(run.seconds)},
                        {"iterations", iterations}});
  }
  return document.dump(1) + "\n";
}

std::string trace_csv(const Summary& solve) {
  std::ostringstream csv;
  csv << "iteration,cost,gradient_max,step_max,step_scale,damping\n";
  csv.precision(12);
  csv << "0," << solve.initial_cost << ",,,,\n";
  int number = 0;
  for (const Iteration& i : solve.iterations) {
    csv << ++number << ',' << i.cost << ',' << i.gradient_max << ',' << i.step_max << ','
        << i.step_scale << ',' << i.damping << '\n';
  }
  return csv.str();
}

std::string picture_name(std::size_t i) {
  char name[32];
  std::snprintf(name, sizeof name, "%04zu.png", i);
  return name;
}

std::string trace_name(std::size_t run, std::size_t runs) {
  if (runs == 1) return "trace.csv";
  char name[32];
  std::snprintf(name, sizeof name, "trace_%03zu.csv", run + 1);
  return name;
}

// All keys that any of the runs sets, in the order in which they first appear.
std::vector<std::string> swept_keys(const std::vector<Run>& runs) {
  std::vector<std::string> keys;
  for (const Run& run : runs) {
    for (const auto& [key, value] : run.measured.settings) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
  }
  return keys;
}

std::string setting(const MeasuredRun& run, const std::string& key) {
  for (const auto& [name, value] : run.settings) {
    if (name == key) return value;
  }
  return "";
}

std::string table_md(const Outcome& outcome) {
  std::string head = "|", rule = "|";
  const auto column = [&](const std::string& name) {
    head += " " + name + " |";
    rule += "---|";
  };
  const std::vector<std::string> keys = swept_keys(outcome.runs);
  for (const std::string& key : keys) column(key);
  for (const char* name : kTableMetrics) column(name);
  std::string text = head + "\n" + rule + "\n";
  for (const Run& run : outcome.runs) {
    text += "|";
    for (const std::string& key : keys) text += " " + setting(run.measured, key) + " |";
    for (const char* name : kTableMetrics) {
      const auto found = run.measured.metrics.find(name);
      text += found == run.measured.metrics.end() ? "  |" : " " + number(found->second) + " |";
    }
    text += "\n";
  }
  return text;
}

// What not every run of a config writes, so that an older run's could be left.
bool may_be_outdated(const fs::path& name) {
  return name.string().starts_with("trace") || name == "table.md" || name == kFrames;
}

}  // namespace

AtomicFolder::AtomicFolder(fs::path target) : target_(std::move(target)) {
  std::error_code error;
  for (fs::path p = target_.parent_path(); !p.empty() && !fs::exists(p, error);) {
    made_.push_back(p);
    p = p.parent_path();
  }
  fs::create_directories(target_.parent_path().empty() ? "." : target_.parent_path(), error);
  const bool taken = !error && fs::exists(target_, error) && !fs::is_directory(target_, error);
  temporary_ = target_.parent_path() /
               ("." + target_.filename().string() + ".partial" + std::to_string(getpid()));
  if (!error && !taken) fs::create_directory(temporary_, error);
  if (!error && !taken) return;
  throw InputError("cannot write the folder '" + target_.string() +
                   "': " + (taken ? "a file of that name is in the way" : error.message()));
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
  for (const fs::path& folder : made_) fs::remove(folder, ignored);  // those that stayed empty
}

void AtomicFolder::commit() {
  try {
    const fs::path old = temporary_.string() + ".old";
    if (fs::exists(target_)) {
      for (const auto& entry : fs::directory_iterator(target_)) {  // what others put there stays
        const fs::path name = entry.path().filename();
        if (fs::exists(temporary_ / name) || may_be_outdated(name)) continue;
        fs::copy(entry.path(), temporary_ / name, fs::copy_options::recursive);
      }
      fs::rename(target_, old);
    }
    fs::rename(temporary_, target_);
    fs::remove_all(old);
  } catch (const fs::filesystem_error& e) {
    throw InputError("cannot write the folder '" + target_.string() + "': " + e.code().message());
  }
}

void write_results(const Outcome& outcome, const fs::path& folder) {
  write_file(folder / "config.yaml", to_yaml(outcome.resolved));
  write_file(folder / "metrics.json", metrics_json(outcome));
  write_file(folder / "times.json", times_json(outcome));
  write_file(folder / "environment.json", Json(environment()).dump(1) + "\n");
  for (std::size_t i = 0; i < outcome.runs.size(); ++i) {
    write_file(folder / trace_name(i, outcome.runs.size()), trace_csv(outcome.runs[i].solve));
  }
  if (outcome.runs.size() > 1) write_file(folder / "table.md", table_md(outcome));
  write_png(outcome.picture, folder / "picture.png");
  if (!outcome.frames.empty()) fs::create_directory(folder / kFrames);
  for (std::size_t i = 0; i < outcome.frames.size(); ++i) {
    write_png(outcome.frames[i], folder / kFrames / picture_name(i));
  }
}

std::string to_json(const Report& report) {
  Json document = flat_solver_json(report.solve);
  add_metrics(metrics_of(report), document);
  document["cost"] = {{"total", report.solve.final_cost},
                      {"by_term", json(report.solve.cost_by_term)}};
  document["seconds"] = json(report.seconds);
  document["seconds"]["solve_by_phase"] = json(report.solve.seconds);
  add_circumstances(report.solve, report.notes, document);
  return document.dump(1) + "\n";
}

std::string to_json(const Run& run) {
  Json document = flat_solver_json(run.solve);
  add_metrics(run.measured.metrics, document);
  for (const char* of_last : {"status", "message", "initial_cost"}) document.erase(of_last);
  document["seconds"] = json(run.seconds);
  add_circumstances(run.solve, run.notes, document);
  return document.dump(1) + "\n";
}

}  // namespace deformlab
