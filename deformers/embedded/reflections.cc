#include "deformers/embedded/reflections.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "deformers/embedded/node_states.h"
#include "energies/catalog.h"
#include "energies/graph/orientation.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

// The weight of `orientation` in each round, in multiples of the least of the other weights. A
// greater weight needs more steps, and is used only while nodes are left inside out.
constexpr double kRounds[] = {1e2, 1e3, 1e4, 1e5};
constexpr int kSweeps = 300;  // of the averaging of rotations

using Neighbors = std::vector<std::vector<int>>;

Neighbors neighbors(const DeformationGraph& graph) {
  Neighbors result(graph.g.cols());
  for (const GraphEdge& e : graph.edges) {
    result[e.j].push_back(e.k);
    result[e.k].push_back(e.j);
  }
  return result;
}

// The direction in which the neighbours of a node extend least.
Eigen::Vector3d normal(const DeformationGraph& graph, const std::vector<int>& around, int j) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const int k : around) {
    const Eigen::Vector3d g_jk = graph.g.col(k) - graph.g.col(j);
    spread += g_jk * g_jk.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
}

// q and −q are the same rotation. Each node takes the sign that is nearer to the neighbour from
// which the search reaches it.
void align(const Neighbors& around, Eigen::Matrix4Xd& q) {
  std::vector<char> seen(around.size(), 0);
  std::vector<int> queue;
  for (std::size_t seed = 0; seed < around.size(); ++seed) {
    if (seen[seed]) continue;
    seen[seed] = 1;
    queue.assign(1, static_cast<int>(seed));
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const int k : around[queue[i]]) {
        if (seen[k]) continue;
        seen[k] = 1;
        queue.push_back(k);
        if (q.col(k).dot(q.col(queue[i])) < 0) q.col(k) = -q.col(k);
      }
    }
  }
}

// The rotations of all nodes. Those that are inside out are mirrored along the normal of their
// neighbours first, which hardly moves a flat patch.
Eigen::Matrix4Xd mirrored_back(const DeformationGraph& graph, const Neighbors& around,
                               const Unknowns& x) {
  Eigen::Matrix4Xd q(4, x.nodes());
  for (int j = 0; j < x.nodes(); ++j) {
    Eigen::Matrix3d R = x.X.block<3, 3>(0, x.first[j]);
    if (R.determinant() < 0) {
      const Eigen::Vector3d n = normal(graph, around[j], j);
      R -= 2 * R * n * n.transpose();
    }
    q.col(j) = Eigen::Quaterniond(nearest_rotation(R)).coeffs();
  }
  align(around, q);
  return q;
}

// A start from which twists unwind: nodes are mirrored back, and the rotations of nodes that no
// handle follows become the means of their neighbours' rotations.
void spread_rotations(const DeformationGraph& graph, const Embedding& handles,
                      const std::vector<char>& fixed, Unknowns& x) {
  const Neighbors around = neighbors(graph);
  std::vector<char> keeps = fixed;
  for (const int j : handles.nodes.reshaped()) keeps[j] = 1;
  Eigen::Matrix4Xd q = mirrored_back(graph, around, x);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int j = 0; j < x.nodes(); ++j) {
      if (keeps[j]) continue;
      Eigen::Vector4d mean = q.col(j);
      for (const int k : around[j]) mean += q.col(k);
      if (mean.norm() > 1e-6) q.col(j) = mean.normalized();
    }
  }
  for (int j = 0; j < x.nodes(); ++j) {
    if (fixed[j]) continue;
    x.X.block<3, 3>(0, x.first[j]) =
        Eigen::Quaterniond(Eigen::Vector4d(q.col(j))).toRotationMatrix();
  }
}

struct Guarded {
  Summary solve;
  double orientation = 0;  // the final cost of the term `orientation`
};

// A term that is part of the problem for as long as this object lives.
class AddedTerm {
 public:
  AddedTerm(Problem& problem, std::unique_ptr<Energy> energy) : problem_(problem) {
    problem.terms.push_back({std::move(energy)});
  }
  ~AddedTerm() { problem_.terms.pop_back(); }
  AddedTerm(const AddedTerm&) = delete;
  AddedTerm& operator=(const AddedTerm&) = delete;
  void set_weight(double weight) { problem_.terms.back().weight = weight; }

 private:
  Problem& problem_;
};

Guarded solve_guarded(Problem& problem, std::unique_ptr<Energy> orientation,
                      const SolverOptions& options) {
  Guarded result;
  double least = std::numeric_limits<double>::max();
  for (const WeightedEnergy& term : problem.terms) least = std::min(least, term.weight);
  AddedTerm added(problem, std::move(orientation));
  for (const double factor : kRounds) {
    added.set_weight(factor * least);
    const std::unique_ptr<Solver> solver = make_solver(options);
    solver->compile(problem);
    result.solve = solver->solve(problem);
    if (count_inside_out(problem.x) == 0) break;
  }
  result.orientation = cost_by_term(problem, problem.x).back();
  return result;
}

// Solves without the term. The result is kept unless more nodes turn over again.
void solve_without_term(Problem& problem, Solver& solver, Guarded& guarded) {
  if (guarded.orientation == 0) return;
  const Eigen::MatrixXd X = problem.x.X;
  const int left = count_inside_out(problem.x);
  Summary free = solver.solve(problem);
  if (free.status != Status::kFailed && count_inside_out(problem.x) <= left) {
    guarded = {std::move(free)};
  } else {
    problem.x.X = X;
  }
}

std::string note(int before, int left, double F_before, double F, double orientation) {
  std::string text = fmt::format(
      "nodes that were inside out and were turned back: {} of {}; F was {:g} and is {:g}",
      before - left, before, F_before, F);
  if (orientation > 0) {
    text += fmt::format(", beside {:g} of the term orientation, without which they turn over again",
                        orientation);
  }
  return text;
}

}  // namespace

int count_inside_out(const Unknowns& x) {
  const int d = x.dimension();
  int count = 0;
  for (int j = 0; j < x.nodes(); ++j) count += x.X.block(0, x.first[j], d, d).determinant() < 0;
  return count;
}

void repair_reflections(Problem& problem, const DeformationGraph& graph, const Embedding& handles,
                        Solver& solver, const SolverOptions& options, Report& report) {
  const int before = count_inside_out(problem.x);
  if (before == 0 || problem.terms.empty()) return;
  Stopwatch watch(report.seconds["repair"]);
  const Eigen::MatrixXd X = problem.x.X;
  const double F_before = cost(problem, problem.x);
  const int d = problem.x.dimension();
  if (d == 3) spread_rotations(graph, handles, problem.fixed, problem.x);
  Guarded guarded = solve_guarded(
      problem,
      make_energy(Orientation<>::kName, {.graph = graph, .handles = handles, .dimension = d}),
      options);
  if (guarded.solve.status == Status::kFailed || count_inside_out(problem.x) >= before) {
    problem.x.X = X;
    report.notes.emplace_back("nodes that are inside out could not be turned back");
    return;
  }
  solve_without_term(problem, solver, guarded);
  report.notes.push_back(note(before, count_inside_out(problem.x), F_before,
                              cost(problem, problem.x), guarded.orientation));
  report.solve = std::move(guarded.solve);
}

}  // namespace deformlab
