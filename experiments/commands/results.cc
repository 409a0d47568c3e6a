#include "experiments/commands/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "drawing/bitmap/webp_movie.h"
#include "experiments/commands/environment.h"
#include "geometry/core/files.h"
#include "geometry/core/output_calls.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFrames = "frames";
constexpr const char* kMovie = "movie.webp";

// Columns of a sweep's table, in addition to the keys that it sweeps over.
constexpr const char* kTableMetrics[] = {"iterations",          "converged", "cost",
                                         "handle_rms_relative", "min_det_R", "shear_mean",
                                         "stretch_max"};

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

// The same for a document that has metrics too, in which the method is called the solver.
Json flat_solver_json(const Summary& s) {
  Json document{{"solver", s.method}};
  document.update(solver_json(s));
  document.erase("method");
  return document;
}

// Adds all metrics but costs. Counts are whole numbers.
void add_metrics(const Metrics& metrics, Json& document) {
  for (const auto& [name, value] : metrics) {
    if (!name.starts_with("cost")) document[name] = value;
  }
  for (const char* count : {"nodes", "edges", "unknowns", "iterations", "factorizations",
                            "inside_out", "frames", "solves", "handles"}) {
    if (document.contains(count)) document[count] = document[count].get<long>();
  }
}

// seconds.compile becomes `compile`, and seconds.solve.factor becomes `factor` in `solve_by_phase`.
Json nested_seconds(const Metrics& seconds) {
  Json document = Json::object();
  for (const auto& [full_name, value] : seconds) {
    const std::string name = full_name.substr(full_name.find('.') + 1);
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos) {
      document[name] = value;
    } else {
      document[name.substr(0, dot) + "_by_phase"][name.substr(dot + 1)] = value;
    }
  }
  return document;
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

Bitmap opaque(const Image& image) {
  Bitmap bitmap(image.width, image.height);
  for (std::size_t i = 0; i < bitmap.rgba.size() / 4; ++i) {
    std::copy_n(image.rgb.data() + 3 * i, 3, bitmap.rgba.data() + 4 * i);
    bitmap.rgba[4 * i + 3] = 255;
  }
  return bitmap;
}

// The pictures of the sequence as one animation, in the time of its frames.
std::string movie_of(const Outcome& outcome) {
  const AnimationOptions& o = outcome.config.run.animation;
  const Image& first = outcome.frames.front();
  const double fps = o.keyframes.fps / std::max(1, o.sequence.every);
  WebpMovie movie(first.width, first.height, fps, o.keyframes.loop);
  for (const Image& picture : outcome.frames) movie.add(opaque(picture));
  return movie.finish();
}

std::string picture_name(std::size_t i) { return fmt::format("{:04}.png", i); }

std::string trace_name(std::size_t run, std::size_t runs) {
  if (runs == 1) return "trace.csv";
  return fmt::format("trace_{:03}.csv", run + 1);
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
      text += found == run.measured.metrics.end() ? "  |" : fmt::format(" {:.6g} |", found->second);
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::vector<std::string> result_names(std::size_t runs, std::size_t frames) {
  std::vector<std::string> names{"config.yaml", "metrics.json", "times.json", "environment.json",
                                 "picture.png"};
  for (std::size_t i = 0; i < runs; ++i) names.push_back(trace_name(i, runs));
  if (runs > 1) names.emplace_back("table.md");
  for (std::size_t i = 0; i < frames; ++i) {
    names.push_back(fmt::format("{}/{}", kFrames, picture_name(i)));
  }
  if (frames > 0) names.emplace_back(kMovie);
  return names;
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
  if (!outcome.frames.empty()) {
    if (const int error = output_calls::make_folder(folder / kFrames, 0777)) {
      cannot_write(folder / kFrames, error);
    }
  }
  for (std::size_t i = 0; i < outcome.frames.size(); ++i) {
    write_png(outcome.frames[i], folder / kFrames / picture_name(i));
  }
  if (!outcome.frames.empty()) write_file(folder / kMovie, movie_of(outcome));
}

std::string to_json(const Run& run) {
  Json document = flat_solver_json(run.solve);
  add_metrics(run.measured.metrics, document);
  if (run.many_solves) {
    for (const char* of_last : {"status", "message", "initial_cost"}) document.erase(of_last);
    document["seconds"] = json(run.seconds);
  } else {
    document["cost"] = {{"total", run.solve.final_cost}, {"by_term", json(run.solve.cost_by_term)}};
    document["seconds"] = nested_seconds(run.seconds);
  }
  add_circumstances(run.solve, run.notes, document);
  return document.dump(1) + "\n";
}

}  // namespace deformlab
