#include <fmt/format.h>

#include <utility>

#include "deformers/embedded/embedded_deformation.h"
#include "deformers/embedded/handles/line_turn.h"
#include "deformers/embedded/harmonic_start.h"
#include "deformers/embedded/node_states.h"
#include "energies/graph/constraint.h"
#include "energies/graph/regularization.h"

// Where a solve starts, and when it starts again.
namespace deformlab {
namespace {

// The weight of a term in the problem, or 0.
template <class Term>
double weight_of(const Problem& problem) {
  for (const WeightedEnergy& term : problem.terms) {
    if (term.energy->name() == Term::kName) return term.weight;
  }
  return 0;
}

}  // namespace

// Chooses where the solve starts that follows.
void EmbeddedDeformation::begin(const Eigen::Matrix3Xd& targets) {
  if (at_rest_ && options_.start == Start::kHarmonic && begin_harmonic(targets)) return;
  translate_pinned(targets);
}

// The rotation vectors of all handles, NaN where nothing is known.
Eigen::Matrix3Xd EmbeddedDeformation::start_rotations(const Eigen::Matrix3Xd& targets) const {
  Eigen::Matrix3Xd rotations = Eigen::Matrix3Xd::Zero(3, handles_.v.cols());
  rotations.leftCols(moved_) =
      handle_rotations(handles_.v.leftCols(moved_), targets.leftCols(moved_), rotations_, groups_);
  rotations.rightCols(satellites_.count()) = rotations(Eigen::all, satellites_.handles).eval();
  for (const std::vector<int>& line : on_one_line_) {
    const auto turn = shortest_turn(handles_.v(Eigen::all, line), targets(Eigen::all, line));
    for (const int l : line) {  // what is not moved is held, but may turn
      if (turn && (l >= moved_ || rotations.col(l).hasNaN())) rotations.col(l) = *turn;
    }
  }
  if (options_.dimension == 2) rotations.topRows(2) *= 0;  // what is unknown stays NaN
  return rotations;
}

bool EmbeddedDeformation::begin_harmonic(const Eigen::Matrix3Xd& targets) {
  const double w_reg = weight_of<Regularization<>>(problem_);
  const double w_con = weight_of<Constraint<>>(problem_);
  if (!(w_reg > 0 && w_con > 0)) return false;
  const Eigen::Matrix3Xd rotations = start_rotations(targets);
  const auto X =
      harmonic_start({graph_, handles_, problem_.fixed, w_reg, w_con}, rotations, targets);
  if (!X) return false;
  set_transformations(*X, options_.node_model(), unit_, problem_.fixed, problem_.x);
  return true;
}

// A component that is pinned at one point may rotate about it at no cost. It starts at the
// translation that moves its handle to the target, which is a minimum.
void EmbeddedDeformation::translate_pinned(const Eigen::Matrix3Xd& targets) {
  if (at_one_point_.empty()) return;
  const int d = options_.dimension;
  const Eigen::Matrix3Xd reached = transfer_positions(transformations(), graph_.g, handles_);
  for (const PointPin& pin : at_one_point_) {
    const Eigen::Matrix3Xd motion = (targets - reached)(Eigen::all, pin.handles);
    const Eigen::Vector3d t = motion.rowwise().mean() / unit_;
    for (const int j : pin.nodes) problem_.x.X.col(problem_.x.first[j + 1] - 1) += t.head(d);
  }
}

void EmbeddedDeformation::set_constraint_weight(double weight) {
  for (WeightedEnergy& term : problem_.terms) {
    if (term.energy->name() == Constraint<>::kName) term.weight = weight;
  }
  solver_->compile(problem_);
}

// Handles that are nearer to the fixed part than nodes are can tear the shape. A smaller weight of
// E_con lets them give way.
void EmbeddedDeformation::relax(const Eigen::Matrix3Xd& targets, Report& report) {
  const double weight = weight_of<Constraint<>>(problem_);
  const auto count = [&] { return determinants(transformations()).inside_out; };
  const int before = count();
  if (!(options_.relaxed_constraint > 0 && options_.relaxed_constraint < weight && before > 0)) {
    return;
  }
  const Unknowns first = problem_.x;
  problem_.x = rest_states(first.nodes());
  at_rest_ = true;
  set_constraint_weight(options_.relaxed_constraint);
  begin(targets);
  Summary relaxed = solver_->solve(problem_);
  set_constraint_weight(weight);
  if (const int after = count(); after < before) {
    report.solve = std::move(relaxed);
    report.notes.push_back(
        fmt::format("handles hold less, with a weight of {:g} instead of {:g}, because of nodes "
                    "that were inside "
                    "out: {} before, {} now",
                    options_.relaxed_constraint, weight, before, after));
  } else {
    problem_.x = first;
  }
}

}  // namespace deformlab
