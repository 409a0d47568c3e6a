#include "deformers/reflections.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <sstream>
#include <utility>

#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

// Of `orientation`, beside terms that weigh 1 to 100: each round weighs it more, while nodes are
// left inside out.
constexpr double kWeights[] = {100, 1e3, 1e4};

struct Guarded {
  Summary solve;
  double orientation = 0;  // what the term counts at the end
};

Guarded solve_guarded(Stage& stage, std::unique_ptr<Energy> orientation,
                      const SolverOptions& options) {
  Guarded result;
  stage.terms.push_back({std::move(orientation)});
  for (const double weight : kWeights) {
    stage.terms.back().weight = weight;
    const std::unique_ptr<Solver> solver = make_solver(options);
    solver->compile(stage);
    result.solve = solver->solve(stage);
    if (count_inside_out(stage.x) == 0) break;
  }
  result.orientation = cost_by_term(stage, stage.x).back();
  stage.terms.pop_back();
  return result;
}

std::string note(int before, int left, double F_before, double F, double orientation) {
  std::ostringstream text;
  text << "nodes that were inside out and were turned back: " << before - left << " of " << before
       << "; F was " << F_before << " and is " << F;
  if (orientation > 0) {
    text << ", beside " << orientation
         << " of the term orientation, without which they turn over again";
  }
  return text.str();
}

}  // namespace

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& R) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) = -U.col(2);
  return U * svd.matrixV().transpose();
}

int count_inside_out(const Unknowns& x) {
  const int d = x.dimension();
  int count = 0;
  for (int j = 0; j < x.nodes(); ++j) count += x.X.block(0, x.first[j], d, d).determinant() < 0;
  return count;
}

void repair_reflections(Stage& stage, std::unique_ptr<Energy> orientation, Solver& solver,
                        const SolverOptions& options, Report& report) {
  const int before = count_inside_out(stage.x);
  if (before == 0) return;
  Stopwatch watch(report.seconds["repair"]);
  const Eigen::MatrixXd X = stage.x.X;
  const double F_before = cost(stage, stage.x);
  Guarded guarded = solve_guarded(stage, std::move(orientation), options);
  const int left = count_inside_out(stage.x);
  if (left >= before) {
    stage.x.X = X;
    return;
  }
  if (guarded.orientation > 0) {
    const Eigen::MatrixXd X_guarded = stage.x.X;
    Summary free = solver.solve(stage);
    if (count_inside_out(stage.x) <= left) {
      guarded = {std::move(free)};
    } else {
      stage.x.X = X_guarded;
    }
  }
  report.notes.push_back(
      note(before, count_inside_out(stage.x), F_before, cost(stage, stage.x), guarded.orientation));
  report.solve = std::move(guarded.solve);
}

}  // namespace deformlab
