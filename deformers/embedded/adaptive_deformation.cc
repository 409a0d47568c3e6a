#include "deformers/embedded/adaptive_deformation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "geometry/core/options.h"

namespace deformlab {
namespace {

constexpr double kNothing = 1e-20;  // a smaller F is the rounding error of a shape at rest

void check(const GraphOptions& graph, const AdaptiveOptions& adaptive) {
  check_options(adaptive);
  const int start = adaptive.start, rounds = adaptive.rounds;
  if (graph.method == NodePlacement::kFile) {
    throw OptionError("start", fmt::format("{}", start),
                      ", but graph.method is file, and such a graph has nodes of its own; use "
                      "another method, or start: 0");
  }
  if (start < 1 || start >= graph.nodes) {
    throw OptionError(
        "start", fmt::format("{}", start),
        fmt::format("; allowed: at least 1 and less than graph.nodes, which is {}", graph.nodes));
  }
  if (rounds > graph.nodes - start) {
    throw OptionError(
        "rounds", fmt::format("{}", rounds),
        fmt::format("; allowed: 1 to {}, the number of nodes to be added", graph.nodes - start));
  }
}

// The options with the number of nodes that the graph begins with.
EmbeddedDeformationOptions at_start(EmbeddedDeformationOptions options, int start) {
  options.graph.nodes = start;
  return options;
}

// Adds the costs of earlier solves to the report of a solve.
void add(const Report& before, Report& report) {
  for (const auto& [phase, seconds] : before.seconds) report.seconds[phase] += seconds;
  for (const auto& [phase, seconds] : before.solve.seconds) report.solve.seconds[phase] += seconds;
  auto& steps = report.solve.iterations;
  steps.insert(steps.begin(), before.solve.iterations.begin(), before.solve.iterations.end());
  report.solve.initial_cost = before.solve.initial_cost;
  report.solve.factorizations += before.solve.factorizations;
  report.solve.cg_iterations += before.solve.cg_iterations;
}

// A vertex that may get a node. Distances and therefore scores only become smaller as nodes are
// chosen, so that a score has to be updated only when it comes to the top of the queue.
struct Candidate {
  double cost, distance;
  int vertex;
  std::size_t seen = 0;  // the number of chosen vertices that the distance accounts for
  double score() const { return cost * distance; }
  bool operator<(const Candidate& o) const {
    return std::pair(score(), -vertex) < std::pair(o.score(), -o.vertex);
  }
};

std::priority_queue<Candidate> candidates_of(const Embedding& vertices, const Eigen::Matrix3Xd& g,
                                             const Eigen::VectorXd& costs) {
  std::priority_queue<Candidate> candidates;
  for (int i = 0; i < vertices.v.cols(); ++i) {
    double cost = 0;
    for (Eigen::Index a = 0; a < vertices.nodes.rows(); ++a) {
      if (vertices.weights(a, i) > 0) cost += costs[vertices.nodes(a, i)];
    }
    const double distance = (vertices.v.col(i) - g.col(vertices.nodes(0, i))).norm();
    if (cost * distance > 0) candidates.push({cost, distance, i});
  }
  return candidates;
}

}  // namespace

Eigen::VectorXd node_costs(const Problem& problem) {
  Eigen::VectorXd costs = Eigen::VectorXd::Zero(problem.x.nodes());
  for (const WeightedEnergy& term : problem.terms) {
    const Energy& energy = *term.energy;
    Eigen::MatrixXd r(energy.rows(), energy.size());
    energy.residuals(problem.x, r.data());
    for (int e = 0; e < energy.size(); ++e) {
      const double share = term.weight * squared_sum(r.col(e), term.loss.get()) / energy.arity();
      for (const int j : energy.nodes(e)) costs[j] += share;
    }
  }
  return costs;
}

std::vector<int> worst_vertices(const Embedding& vertices, const Eigen::Matrix3Xd& g,
                                const Eigen::VectorXd& costs, int count) {
  auto candidates = candidates_of(vertices, g, costs);
  std::vector<int> worst;
  while (static_cast<int>(worst.size()) < count && !candidates.empty()) {
    Candidate top = candidates.top();
    candidates.pop();
    if (top.seen == worst.size()) {
      worst.push_back(top.vertex);
      continue;
    }
    for (; top.seen < worst.size(); ++top.seen) {
      const auto away = vertices.v.col(top.vertex) - vertices.v.col(worst[top.seen]);
      top.distance = std::min(top.distance, away.norm());
    }
    if (top.score() > 0) candidates.push(top);
  }
  return worst;
}

Transformations continued(const EmbeddedDeformation& deformation, std::span<const int> vertices) {
  const Transformations X = deformation.transformations();
  const Embedding at = subset(deformation.embedding(), vertices);
  const Eigen::Matrix3Xd places = transfer_positions(X, deformation.graph().g, at);
  Transformations result = Transformations::Zero(3, X.cols() + 4 * places.cols());
  result.leftCols(X.cols()) = X;
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    auto node = result.middleCols<4>(X.cols() + 4 * i);
    for (Eigen::Index a = 0; a < at.nodes.rows(); ++a) {
      node.leftCols<3>() += at.weights(a, i) * X.middleCols<3>(4 * at.nodes(a, i));
    }
    node.col(3) = places.col(i) - at.v.col(i);
  }
  return result;
}

const EmbeddedDeformation* as_embedded(const Deformer& deformer) {
  const auto* adaptive = dynamic_cast<const AdaptiveDeformation*>(&deformer);
  return adaptive ? &adaptive->embedded() : dynamic_cast<const EmbeddedDeformation*>(&deformer);
}

AdaptiveDeformation::AdaptiveDeformation(Shape rest, const EmbeddedDeformationOptions& options,
                                         const AdaptiveOptions& adaptive, std::span<const Cut> cuts)
    : rest_(std::move(rest)),
      options_(options),
      adaptive_(adaptive),
      cuts_(cuts.begin(), cuts.end()) {
  inside_option("adaptive", [&] { check(options_.graph, adaptive_); });
  refuse_interior(options_.graph,
                  "a graph that grows (adaptive.start) has nodes on the surface only");
  // This method has its own rules for where nodes are and how many.
  options_.graph.region = NodeRegion::kWhole;
  options_.graph.fit = false;
  embedded_ =
      std::make_unique<EmbeddedDeformation>(rest_, at_start(options_, adaptive_.start), cuts_);
}

void AdaptiveDeformation::compile(const Handles& handles) {
  embedded_->compile(handles);
  handles_ = handles;
}

// The number of nodes after m. Every round multiplies it by about the same factor.
int AdaptiveDeformation::next_count(int m) const {
  const auto& [start, rounds] = adaptive_;
  const double nodes = options_.graph.nodes;
  for (int round = 1; round < rounds; ++round) {
    const double share = static_cast<double>(round) / rounds;
    const auto count = static_cast<int>(std::lround(start * std::pow(nodes / start, share)));
    if (count > m) return count;
  }
  return options_.graph.nodes;
}

// Adds nodes. Returns false where no node can be added or the terms cost nothing.
bool AdaptiveDeformation::refine() {
  const int m = static_cast<int>(embedded_->graph().g.cols());
  if (m >= options_.graph.nodes) return false;
  const Eigen::VectorXd costs = node_costs(embedded_->problem());
  if (!(costs.sum() > kNothing)) return false;
  const std::vector<int> added =
      worst_vertices(embedded_->embedding(), embedded_->graph().g, costs, next_count(m) - m);
  if (added.empty()) return false;
  Eigen::Matrix3Xd g(3, m + static_cast<Eigen::Index>(added.size()));
  g << embedded_->graph().g, rest_.V(Eigen::all, added);
  auto finer =
      std::make_unique<EmbeddedDeformation>(rest_, g, at_start(options_, adaptive_.start), cuts_);
  finer->compile(handles_);
  finer->begin_at(continued(*embedded_, added));
  embedded_ = std::move(finer);
  return true;
}

Report AdaptiveDeformation::update(const Eigen::Matrix3Xd& targets) {
  Report report = embedded_->update(targets);
  while (report.solve.status != Status::kFailed && refine()) {
    const Report before = std::exchange(report, embedded_->update(targets));
    add(before, report);
  }
  const int wanted = options_.graph.nodes;
  if (report.nodes < wanted && node_costs(embedded_->problem()).sum() > kNothing) {
    report.notes.push_back(
        fmt::format("the graph has {} nodes instead of graph.nodes, {}: every "
                    "vertex where the terms cost anything has one",
                    report.nodes, wanted));
  }
  return report;
}

}  // namespace deformlab
