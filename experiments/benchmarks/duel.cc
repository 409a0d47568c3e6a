#include "experiments/benchmarks/duel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "deformers/baselines/cgal_arap.h"
#include "experiments/benchmarks/reference_scene.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr double kSlow = 3000;    // ms: measured once
constexpr int kManyNodes = 2000;  // on more, only Ceres' likely best is tried
constexpr double kHardSide = 2;
constexpr double kDrag = 0.01;       // of the side
constexpr double kArapClose = 1e-4;  // of the side
constexpr std::size_t kMostArap = 200;

struct Run {
  double ms;
  Summary solve;
};

struct Way {
  std::string name;
  std::function<Run()> run;
};

std::string describe(const SolverOptions& o) {
  if (o.method == SolverMethod::kCeres) {
    return fmt::format("ceres {}, {}, {}, one block a {}", o.linear_solver,
                       name_of(o.ceres_sparse_library), name_of(o.ceres_trust_region),
                       name_of(o.ceres_blocks));
  }
  return "gauss_newton " + o.linear_solver + ", " + o.globalization;
}

Eigen::Matrix3Xd targets(double side, double lift) {
  Eigen::Matrix3Xd result = reference_scene().targets;
  for (auto target : result.colwise()) target.z() += target.x() > 0.5 ? lift : 0;
  return side > 0 ? Eigen::Matrix3Xd(side * result) : result;
}

// An update without the transfer, which is the same for all solvers.
Run timed_update(EmbeddedDeformation& deformation, const Eigen::Matrix3Xd& targets) {
  double seconds = 0;
  Report report;
  {
    Stopwatch watch(seconds);
    report = deformation.update(targets);
  }
  return {1e3 * (seconds - report.seconds.at("transfer")), report.solve};
}

// From rest, compilation counted.
Way from_rest(int nodes, const SolverOptions& options, double side) {
  auto deformation =
      std::make_shared<EmbeddedDeformation>(reference_deformation(nodes, options, side));
  return {describe(options), [deformation, side] {
            double seconds = 0;
            deformation->reset();
            {
              Stopwatch watch(seconds);
              deformation->compile(reference_scene().handles);
            }
            const Run update = timed_update(*deformation, targets(side, 0));
            return Run{1e3 * seconds + update.ms, update.solve};
          }};
}

// One drag after another, to and fro, from where the last one ended. The second of two is timed: in
// between, the other solver has had the caches.
Way warm(int nodes, const SolverOptions& options) {
  auto deformation = std::make_shared<EmbeddedDeformation>(reference_deformation(nodes, options));
  deformation->compile(reference_scene().handles);
  deformation->update(targets(0, 0));
  return {describe(options), [deformation] {
            deformation->update(targets(0, kDrag));
            return timed_update(*deformation, targets(0, 0));
          }};
}

// Until an iteration moves no vertex by more than kArapClose.
Way arap() {
  CgalArapOptions options;
  options.iterations = 1;
  options.tolerance = 1e-12;
  auto deformation = std::make_shared<CgalArap>(reference_scene().shape, options);
  return {"CGAL as-rigid-as-possible, spokes and rims, until nothing moves by 1e-4 of the side",
          [deformation] {
            double seconds = 0;
            deformation->reset();
            {
              Stopwatch watch(seconds);
              deformation->compile(reference_scene().handles);
            }
            Summary solve;
            std::size_t steps = 0;
            double moved = 1;
            while (moved > kArapClose && steps < kMostArap) {
              const Eigen::Matrix3Xd before = deformation->deformed().V;
              {
                Stopwatch watch(seconds);
                solve = deformation->update(reference_scene().targets).solve;
              }
              moved = (deformation->deformed().V - before).colwise().norm().maxCoeff();
              ++steps;
            }
            solve.iterations.resize(steps);
            solve.status = moved > kArapClose ? Status::kMaxIterations : Status::kConverged;
            return Run{1e3 * seconds, solve};
          }};
}

// Ours with the transfer, as the other method moves vertices too.
Way with_transfer(int nodes) {
  auto deformation =
      std::make_shared<EmbeddedDeformation>(reference_deformation(nodes, SolverOptions{}));
  return {describe(SolverOptions{}) + ", and the transfer", [deformation] {
            double seconds = 0;
            deformation->reset();
            Summary solve;
            {
              Stopwatch watch(seconds);
              deformation->compile(reference_scene().handles);
              solve = deformation->update(reference_scene().targets).solve;
            }
            return Run{1e3 * seconds, solve};
          }};
}

Duel fight(std::string row, int nodes, double target, const Way& ours, const Way& theirs,
           int repetitions) {
  Duel duel;
  duel.row = std::move(row);
  duel.nodes = nodes;
  duel.target = target;
  duel.ours = ours.name;
  duel.theirs = theirs.name;
  ours.run();  // warms up
  for (int i = 0; i < repetitions; ++i) {
    const Run a = ours.run(), b = theirs.run();
    duel.our_ms.push_back(a.ms);
    duel.their_ms.push_back(b.ms);
    duel.our_status = to_string(a.solve.status);
    duel.their_status = to_string(b.solve.status);
    duel.our_steps = a.solve.iterations.size();
    duel.their_steps = b.solve.iterations.size();
    duel.our_cost = a.solve.final_cost;
    duel.their_cost = b.solve.final_cost;
    if (b.ms > kSlow) break;
  }
  return duel;
}

std::vector<SolverOptions> ceres_ways(int nodes, double side) {
  std::vector<SolverOptions> result;
  const auto add = [&](const char* linear_solver, const char* blocks, const char* trust_region) {
    SolverOptions o;
    o.method = SolverMethod::kCeres;
    o.linear_solver = linear_solver;
    o.ceres_blocks = value_of<CeresBlocks>(blocks).value();
    o.ceres_trust_region = value_of<CeresTrustRegion>(trust_region).value();
    result.push_back(o);
  };
  add("sparse_normal_cholesky", "column", "levenberg_marquardt");
  if (nodes > kManyNodes && side > 0) return result;  // a solve takes minutes
  add("sparse_normal_cholesky", "column", "dogleg");
  if (nodes > kManyNodes) return result;
  add("sparse_normal_cholesky", "node", "levenberg_marquardt");
  add("sparse_normal_cholesky", "node", "dogleg");
  return result;
}

// The fastest of Ceres' ways from rest that ends where ours does, each tried once.
SolverOptions best_of_ceres(int nodes, double side) {
  const std::vector<SolverOptions> ways = ceres_ways(nodes, side);
  SolverOptions best = ways.front();
  if (ways.size() == 1) return best;
  const double cost = from_rest(nodes, SolverOptions{}, side).run().solve.final_cost;
  double least = std::numeric_limits<double>::infinity();
  for (const SolverOptions& options : ways) {
    const Run run = from_rest(nodes, options, side).run();
    const bool same = std::abs(run.solve.final_cost - cost) <= 1e-6 * cost;
    if (same && run.ms < least) best = options, least = run.ms;
  }
  return best;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

// The ratios aimed at, at 222, 425, 1048 and 4000 nodes.
double target(const std::vector<double>& targets, int nodes) {
  const std::vector<int> sizes = {222, 425, 1048, 4000};
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (nodes == sizes[i]) return targets[i];
  }
  return 0;
}

}  // namespace

double Duel::ratio() const { return median(their_ms) / median(our_ms); }

bool Duel::same_minimum() const { return our_cost <= (1 + 1e-6) * their_cost; }

std::vector<Duel> duels(int nodes, int repetitions) {
  const SolverOptions ours;
  SolverOptions direct;
  direct.linear_solver = "cholmod";
  const SolverOptions ceres = best_of_ceres(nodes, 0), hard = best_of_ceres(nodes, kHardSide);
  std::vector<Duel> result;
  result.push_back(fight("from rest, against Ceres", nodes, target({30, 50, 80, 120}, nodes),
                         from_rest(nodes, ours, 0), from_rest(nodes, ceres, 0), repetitions));
  result.push_back(fight("a drag of 1 % of the side, against Ceres", nodes,
                         target({100, 120, 150, 150}, nodes), warm(nodes, ours), warm(nodes, ceres),
                         2 * repetitions));
  result.push_back(fight("a hard scene from rest, against Ceres", nodes,
                         target({30, 40, 60, 60}, nodes), from_rest(nodes, ours, kHardSide),
                         from_rest(nodes, hard, kHardSide), repetitions));
  result.push_back(fight("from rest, against our CHOLMOD path", nodes,
                         target({15, 20, 30, 60}, nodes), from_rest(nodes, ours, 0),
                         from_rest(nodes, direct, 0), repetitions));
  result.push_back(fight("from rest with the transfer, against CGAL", nodes,
                         target({200, 150, 60}, nodes), with_transfer(nodes), arap(), 1));
  return result;
}

}  // namespace deformlab
