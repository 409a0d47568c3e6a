#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <map>

#include "experiments/commands/atomic_folder.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/manifest.h"
#include "experiments/commands/results.h"
#include "experiments/commands/standard_streams.h"
#include "experiments/subjects/outputs.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

// Progress goes to standard error, because results go to standard output.
void show_progress(const std::string& name, std::size_t i, std::size_t n, const std::string& what) {
  std::fprintf(stderr, "%s: run %zu of %zu%s%s\n", name.c_str(), i, n, what.empty() ? "" : ": ",
               what.c_str());
}

// A solve that failed has no result. Only a config with a claim about `converged` may expect one.
bool report_failures(const std::string& name, const Outcome& outcome) {
  bool failed = false, expected = false;
  for (const Claim& claim : outcome.config.claims) expected |= claim.measure == "converged";
  for (std::size_t i = 0; i < outcome.runs.size(); ++i) {
    const Summary& solve = outcome.runs[i].solve;
    if (solve.status != Status::kFailed) continue;
    print_out(fmt::format("{}: run {}: the solver failed: {}\n", name, i + 1, solve.message));
    failed = true;
  }
  return !failed || expected;
}

// The folder of results is replaced as a whole, with all that earlier runs have written.
void check_inputs_stay(const fs::path& config, const Plan& plan, const fs::path& folder) {
  std::vector<NamedFile> inputs{{config.string(), "the config"}}, outputs;
  for (const ConfigNode& root : plan.roots) {
    std::ranges::move(files_in(root), std::back_inserter(inputs));
  }
  const Manifest manifest(folder);
  for (const std::string& name : manifest.names()) {
    outputs.push_back({(folder / name).string(), "the result"});
  }
  check_distinct(inputs, outputs);
}

// Returns whether every claim holds or falls short for a known reason.
bool run_config(const fs::path& config, const Plan& plan, const fs::path& out) {
  const std::string name = config.stem().string();
  AtomicFolder folder(out / name, result_names(plan.runs.size(), 0));
  const Outcome outcome = run_experiment(
      plan, [&](auto i, auto n, const auto& what) { show_progress(name, i, n, what); });
  folder.begin(result_names(outcome.runs.size(), outcome.frames.size()));
  write_results(outcome, folder.path());
  folder.commit();
  bool good = report_failures(name, outcome);
  for (const ClaimResult& claim : outcome.claims) {
    print_out(claim.line() + "\n");
    good = good && (claim.holds || !claim.known.empty());
  }
  print_out(fmt::format("{}: {} run{}, results in {}\n", name, outcome.runs.size(),
                        outcome.runs.size() == 1 ? "" : "s", (out / name).string()));
  return good;
}

// Throws InputError for two configs with the same name, because their folder has this name.
void check_names(const std::vector<fs::path>& configs) {
  std::map<fs::path, fs::path> by_name;
  for (const fs::path& config : configs) {
    const auto [first, is_new] = by_name.emplace(config.stem(), config);
    if (is_new) continue;
    throw InputError(
        fmt::format("'{}' and '{}' would write one folder '{}'; run them with different --out",
                    first->second.string(), config.string(), config.stem().string()));
  }
}

}  // namespace

int run_command(const std::vector<std::string>& arguments, const fs::path& out) {
  std::vector<fs::path> configs;
  std::vector<Override> overrides;
  for (const std::string& argument : arguments) {
    std::error_code ignored;  // an override may be too long for a file name
    if (argument.find('=') != std::string::npos && !fs::exists(argument, ignored)) {
      overrides.push_back(parse_override(argument));
    } else {
      configs.emplace_back(argument);
    }
  }
  if (configs.empty()) {
    throw InputError("run which config? for example: deformlab run configs/sumner_figure_3.yaml");
  }
  check_names(configs);
  std::vector<Plan> plans;
  for (const fs::path& config : configs) plans.push_back(plan_experiment(config, overrides));
  for (std::size_t i = 0; i < configs.size(); ++i) {
    check_inputs_stay(configs[i], plans[i], out / configs[i].stem());
  }
  bool good = true;
  for (std::size_t i = 0; i < configs.size(); ++i) {
    good = run_config(configs[i], plans[i], out) && good;
  }
  write_gallery(out);
  return good ? 0 : 1;
}

}  // namespace deformlab
