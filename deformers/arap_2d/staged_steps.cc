#include "deformers/arap_2d/staged_steps.h"

#include <algorithm>
#include <complex>
#include <utility>

#include "energies/term_energy.h"
#include "energies/triangle/edge_fit.h"
#include "energies/triangle/fitting.h"
#include "energies/triangle/point_constraint.h"
#include "energies/triangle/similarity.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr double kPull = 1e4;        // of a place, in the greatest weight of a triangle
constexpr int kMostShifts = 50;      // of targets
constexpr double kSettled = 1e-12;   // [mean edge]: gaps that change by less have come to rest
constexpr double kCollapsed = 1e-8;  // a fitted edge of less of its length has no direction

template <class Term>
std::unique_ptr<Energy> energy(Terms<Term> sum) {
  return std::make_unique<TermEnergy<Term>>(std::move(sum));
}

double mean_edge(const Triangulation& mesh) {
  double sum = 0;
  for (const auto f : mesh.F.colwise()) {
    for (int c = 0; c < 3; ++c) sum += (mesh.V.col(f[(c + 1) % 3]) - mesh.V.col(f[c])).norm();
  }
  return sum / static_cast<double>(3 * mesh.F.cols());
}

Unknowns vertices(const Triangulation& mesh) {
  return Unknowns::uniform(mesh.V, static_cast<int>(mesh.V.cols()));
}

std::complex<double> to_complex(const Eigen::Vector2d& v) { return {v.x(), v.y()}; }

// As three different vertices: those of any triangle at a place that is a vertex.
BarycentricPoint in_triangle(const BarycentricPoint& place, const Triangulation& mesh) {
  if (place.vertices[0] != place.vertices[1]) return place;
  for (const auto f : mesh.F.colwise()) {
    for (int c = 0; c < 3; ++c) {
      if (f[c] == place.vertices[0]) return {f, Eigen::Vector3d::Unit(c)};
    }
  }
  return place;  // no vertex is without a triangle: `check` saw to it
}

}  // namespace

StagedSteps::StagedSteps(const Triangulation& mesh, const Eigen::VectorXd& weights, int refinements,
                         const SolverOptions& solver)
    : weights_(weights), refinements_(refinements), V_(mesh.V) {
  check(mesh, weights);
  unit_ = mean_edge(mesh);
  origin_ = mesh.V.rowwise().mean();
  mesh_ = {(mesh.V.colwise() - origin_) / unit_, mesh.F};
  components_ = components(mesh_);
  for (Solved* step : {&similarity_, &fitting_, &edges_}) step->solver = make_solver(solver);
  similarity_.problem.x = edges_.problem.x = vertices(mesh_);
  fitting_.problem.x = Fitting::rest(mesh_);
  fitting_.problem.fixed.assign(fitting_.problem.x.nodes(), 0);
  fitting_.problem.terms.push_back({energy(Fitting::over(mesh_, weights_)), 1});
  fitting_.solver->compile(fitting_.problem);
  reset();
}

void StagedSteps::reset() {
  similarity_.problem.x.X = edges_.problem.x.X = mesh_.V;
  R_ = Eigen::VectorXcd::Ones(mesh_.F.cols());
  corners_ = mesh_.V(Eigen::all, mesh_.F.reshaped());
  V_ = to_lengths(mesh_.V);
}

void StagedSteps::compile(const std::vector<BarycentricPoint>& places) {
  held_.assign(mesh_.V.cols(), 0);
  held_vertices_.clear();
  carried_.clear();
  places_.clear();
  place_.clear();
  hold_parts(places);
  put_terms();
}

// A part that is held at fewer than two places has no step one: it stays, or moves as a whole.
void StagedSteps::hold_parts(const std::vector<BarycentricPoint>& places) {
  Eigen::VectorXcd p(mesh_.V.cols());
  p.real() = mesh_.V.row(0);
  p.imag() = mesh_.V.row(1);
  HoldNotes holds;
  for (const MeshComponent& component : components_) {
    const auto& own = component.vertices;
    std::vector<int> index;
    std::vector<BarycentricPoint> its;
    for (int i = 0; i < std::ssize(places); ++i) {
      if (!std::binary_search(own.begin(), own.end(), places[i].vertices[0])) continue;
      index.push_back(i);
      its.push_back(places[i]);
    }
    const Hold hold = its.empty() ? Hold::kFree : differ(its, p) ? Hold::kShape : Hold::kPoint;
    holds.add(component, hold);
    if (hold == Hold::kShape) continue;
    for (const int v : own) held_[v] = 1;
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    for (const BarycentricPoint& place : its)
      at += place.at(mesh_.V) / static_cast<double>(its.size());
    carried_.push_back({own, index, at});
  }
  notes_ = holds.notes();
  for (const Cluster& cluster : clusters(places, mesh_.V.cols())) hold(places, cluster);
}

void StagedSteps::hold(const std::vector<BarycentricPoint>& places, const Cluster& cluster) {
  const int v = cluster.vertices.front();
  if (held_[v]) return;  // of a part that moves as a whole
  if (cluster.vertices.size() == 1) {
    held_[v] = 1;
    held_vertices_.push_back({v, cluster.places});
    return;
  }
  for (const int i : cluster.places) {
    places_.push_back(in_triangle(places[i], mesh_));
    place_.push_back(i);
  }
}

void StagedSteps::put_terms() {
  const Hinges weak = hinges(mesh_, weights_);
  for (Solved* step : {&similarity_, &edges_}) {
    step->problem.fixed = held_;
    step->problem.terms.clear();
    const double pull = kPull * weights_.maxCoeff();
    step->problem.terms.push_back({energy(PointConstraint::over(mesh_, places_)), pull});
  }
  similarity_.problem.terms.push_back({energy(Similarity::over(mesh_, weights_)), 1});
  if (weak.F.cols() > 0) {
    const Triangulation between{mesh_.V, weak.F};
    similarity_.problem.terms.push_back({energy(Similarity::over(between, weak.weights)), 1});
  }
  edges_.problem.terms.push_back({energy(EdgeFit::over(mesh_, weights_)), 1});
  for (Solved* step : {&similarity_, &edges_}) step->solver->compile(step->problem);
}

void StagedSteps::carry(const Eigen::Matrix2Xd& q) {
  for (const auto& [vertices, places, at] : carried_) {
    Eigen::Vector2d by = Eigen::Vector2d::Zero();
    if (!places.empty()) by = q(Eigen::all, places).rowwise().mean() - at;
    for (const int v : vertices) {
      similarity_.problem.x.X.col(v) = edges_.problem.x.X.col(v) = mesh_.V.col(v) + by;
    }
  }
}

void StagedSteps::put_held(const Eigen::Matrix2Xd& q, Unknowns& x) const {
  for (const auto& [v, places] : held_vertices_) {
    x.X.col(v) = q(Eigen::all, places).rowwise().mean();
  }
}

void StagedSteps::solve(Solved& step) {
  Summary summary = step.solver->solve(step.problem);
  for (const auto& [term, cost] : summary.cost_by_term) summary_.cost_by_term[term] = cost;
  summary.cost_by_term = std::move(summary_.cost_by_term);
  summary.seconds = std::move(summary_.seconds);
  if (summary_.status == Status::kFailed) {
    summary.status = summary_.status;
    summary.message = summary_.message;
  }
  summary_ = std::move(summary);
}

// Shifts the targets of places by what they are missed by until that changes no more.
void StagedSteps::solve_held(Solved& step, const Eigen::Matrix2Xd& q) {
  put_held(q, step.problem.x);
  const Eigen::Matrix2Xd targets = q(Eigen::all, place_);
  Eigen::Matrix2Xd shift = Eigen::Matrix2Xd::Zero(2, targets.cols()), gap = shift;
  for (int i = 0; i < kMostShifts; ++i) {
    step.problem.terms.front().energy->set_targets(targets + shift);
    solve(step);
    const Eigen::Matrix2Xd last = std::exchange(gap, targets);
    for (Eigen::Index l = 0; l < gap.cols(); ++l) gap.col(l) -= places_[l].at(step.problem.x.X);
    if (gap.cols() == 0 || (gap - last).cwiseAbs().maxCoeff() <= kSettled) return;
    shift += gap;
  }
}

// Eq. 9–11 and the scaling after them: only the direction of the fitted edge is needed.
void StagedSteps::fit(const Eigen::MatrixXd& intermediate) {
  fitting_.problem.terms.front().energy->set_targets(intermediate);
  solve(fitting_);
  const Eigen::MatrixXd& v = fitting_.problem.x.X;
  for (Eigen::Index f = 0; f < mesh_.F.cols(); ++f) {
    const Eigen::Matrix<double, 2, 3> p = mesh_.V(Eigen::all, mesh_.F.col(f));
    const std::complex<double> s =
        to_complex(v.col(2 * f + 1) - v.col(2 * f)) / to_complex(p.col(1) - p.col(0));
    if (std::abs(s) > kCollapsed) R_[f] = s / std::abs(s);
    const Eigen::Vector2d from = p.rowwise().mean();
    const Eigen::Vector2d to = intermediate(Eigen::all, mesh_.F.col(f)).rowwise().mean();
    for (int c = 0; c < 3; ++c) {
      const std::complex<double> corner = R_[f] * to_complex(p.col(c) - from);
      corners_.col(3 * f + c) << to.x() + corner.real(), to.y() + corner.imag();
    }
  }
}

void StagedSteps::update(const Eigen::Matrix2Xd& targets) {
  const Eigen::Matrix2Xd q = (targets.colwise() - origin_) / unit_;
  summary_ = {};
  summary_.status = Status::kConverged;
  seconds_ = {};
  carry(q);
  {
    Stopwatch watch(seconds_.step_one);
    solve_held(similarity_, q);
  }
  {
    Stopwatch watch(seconds_.fit);
    fit(similarity_.problem.x.X);
  }
  {
    Stopwatch watch(seconds_.step_two);
    for (int i = 0; i <= refinements_; ++i) {
      if (i > 0) fit(edges_.problem.x.X);
      edges_.problem.terms.back().energy->set_targets(corners_);
      solve_held(edges_, q);
    }
  }
  V_ = to_lengths(edges_.problem.x.X);
  summary_.seconds = {{"step_one", seconds_.step_one},
                      {"fit", seconds_.fit},
                      {"step_two", seconds_.step_two},
                      {"total", seconds_.step_one + seconds_.fit + seconds_.step_two}};
}

}  // namespace deformlab
