#include "deformers/arap_2d/general_steps.h"

#include <complex>
#include <utility>

#include "deformers/arap_2d/rest_mesh_check.h"
#include "energies/term_energy.h"
#include "energies/triangle/edge_fit.h"
#include "energies/triangle/fitting.h"
#include "energies/triangle/point_constraint.h"
#include "energies/triangle/similarity.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

// The weight of a point_constraint, as a multiple of the greatest weight of a triangle.
constexpr double kConstraintWeight = 1e4;
constexpr int kMostShifts = 50;      // the greatest number of shifts of the targets
constexpr double kSettled = 1e-12;   // shifts end when gaps change by less than this [mean edge]
constexpr double kCollapsed = 1e-8;  // a shorter fitted edge has no direction [its length at rest]

template <class Term>
std::unique_ptr<Energy> energy(Terms<Term> sum) {
  return std::make_unique<TermEnergy<Term>>(std::move(sum));
}

Unknowns vertices(const Triangulation& mesh) {
  return Unknowns::uniform(mesh.V, static_cast<int>(mesh.V.cols()));
}

std::complex<double> to_complex(const Eigen::Vector2d& v) { return {v.x(), v.y()}; }

// A point at a vertex names this vertex three times. The term needs three different vertices, so
// such a point is given as a corner of any triangle there.
BarycentricPoint in_triangle(const BarycentricPoint& point, const Triangulation& mesh) {
  if (point.vertices[0] != point.vertices[1]) return point;
  for (const auto f : mesh.F.colwise()) {
    for (int c = 0; c < 3; ++c) {
      if (f[c] == point.vertices[0]) return {f, Eigen::Vector3d::Unit(c)};
    }
  }
  return point;  // unreachable, because check_rest_mesh refuses vertices without a triangle
}

}  // namespace

GeneralSteps::GeneralSteps(const Triangulation& mesh, const Eigen::VectorXd& weights,
                           int refinements, const SolverOptions& solver)
    : weights_(weights), refinements_(refinements), V_(mesh.V) {
  check_rest_mesh(mesh, weights);
  unit_ = mean_edge_length(mesh);
  origin_ = mesh.V.rowwise().mean();
  mesh_ = {(mesh.V.colwise() - origin_) / unit_, mesh.F};
  components_ = components(mesh_);
  for (Step* step : {&similarity_, &fitting_, &edge_fit_}) step->solver = make_solver(solver);
  similarity_.problem.x = edge_fit_.problem.x = vertices(mesh_);
  fitting_.problem.x = Fitting::rest(mesh_);
  fitting_.problem.fixed.assign(fitting_.problem.x.nodes(), 0);
  fitting_.problem.terms.push_back({energy(Fitting::over(mesh_, weights_)), 1});
  fitting_.solver->compile(fitting_.problem);
  reset();
}

void GeneralSteps::reset() {
  similarity_.problem.x.X = edge_fit_.problem.x.X = mesh_.V;
  R_ = Eigen::VectorXcd::Ones(mesh_.F.cols());
  corners_ = mesh_.V(Eigen::all, mesh_.F.reshaped());
  V_ = to_lengths(mesh_.V);
}

void GeneralSteps::compile(const std::vector<BarycentricPoint>& points) {
  fixed_.assign(mesh_.V.cols(), 0);
  vertex_handles_.clear();
  translated_.clear();
  points_.clear();
  target_.clear();
  fix_translated_components(points);
  for (const HandleCluster& cluster : cluster_handles(points)) {
    add_cluster(points, cluster);
  }
  compile_problems();
}

// A component with handles at fewer than two points has no step one.
void GeneralSteps::fix_translated_components(const std::vector<BarycentricPoint>& points) {
  const Eigen::VectorXcd p = all_to_complex(mesh_.V);
  const double extent = extent_of(p);
  MotionNotes motions;
  for (const MeshComponent& component : components_) {
    const std::vector<int> index = points_inside(component, points);
    std::vector<BarycentricPoint> own;
    for (const int i : index) own.push_back(points[i]);
    const ComponentMotion motion = motion_of(!own.empty(), are_distinct(own, p, extent));
    motions.add(component, motion);
    if (motion == ComponentMotion::kDeformation) continue;
    for (const int v : component.vertices) fixed_[v] = 1;
    Eigen::Vector2d center = Eigen::Vector2d::Zero();
    for (const BarycentricPoint& point : own) {
      center += point.at(mesh_.V) / static_cast<double>(own.size());
    }
    translated_.push_back({component.vertices, index, center});
  }
  notes_ = motions.notes();
}

// Adds the handles of a cluster, which are at a vertex or become constraints.
void GeneralSteps::add_cluster(const std::vector<BarycentricPoint>& points,
                               const HandleCluster& cluster) {
  const int v = cluster.vertices.front();
  if (fixed_[v]) return;  // it belongs to a translated component
  if (cluster.vertices.size() == 1) {
    fixed_[v] = 1;
    vertex_handles_.push_back({v, cluster.points});
    return;
  }
  for (const int i : cluster.points) {
    points_.push_back(in_triangle(points[i], mesh_));
    target_.push_back(i);
  }
}

void GeneralSteps::compile_problems() {
  for (Step* step : {&similarity_, &edge_fit_}) {
    step->problem.fixed = fixed_;
    step->problem.terms.clear();
    const double weight = kConstraintWeight * weights_.maxCoeff();
    step->problem.terms.push_back({energy(PointConstraint::over(mesh_, points_)), weight});
  }
  similarity_.problem.terms.push_back({energy(Similarity::over(mesh_, weights_)), 1});
  const Hinges weak = hinges(mesh_, weights_);
  if (weak.F.cols() > 0) {
    const Triangulation between{mesh_.V, weak.F};
    similarity_.problem.terms.push_back({energy(Similarity::over(between, weak.weights)), 1});
  }
  edge_fit_.problem.terms.push_back({energy(EdgeFit::over(mesh_, weights_)), 1});
  for (Step* step : {&similarity_, &edge_fit_}) step->solver->compile(step->problem);
  ++compilations_;
}

void GeneralSteps::translate_components(const Eigen::Matrix2Xd& q) {
  for (const auto& [vertices, handles, center] : translated_) {
    Eigen::Vector2d translation = Eigen::Vector2d::Zero();
    if (!handles.empty()) translation = q(Eigen::all, handles).rowwise().mean() - center;
    for (const int v : vertices) {
      similarity_.problem.x.X.col(v) = edge_fit_.problem.x.X.col(v) = mesh_.V.col(v) + translation;
    }
  }
}

// Solves a step and adds its summary to that of the update, where the first failure remains.
void GeneralSteps::solve(Step& step) {
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

// Shifts the targets of the constraints by the gaps that remain, until the gaps do not change.
void GeneralSteps::solve_with_handles(Step& step, const Eigen::Matrix2Xd& q) {
  for (const auto& [v, handles] : vertex_handles_) {
    step.problem.x.X.col(v) = q(Eigen::all, handles).rowwise().mean();
  }
  const Eigen::Matrix2Xd targets = q(Eigen::all, target_);
  Eigen::Matrix2Xd shift = Eigen::Matrix2Xd::Zero(2, targets.cols()), gap = shift;
  for (int i = 0; i < kMostShifts; ++i) {
    step.problem.terms.front().energy->set_targets(targets + shift);
    solve(step);
    const Eigen::Matrix2Xd last = std::exchange(gap, targets);
    for (Eigen::Index l = 0; l < gap.cols(); ++l) gap.col(l) -= points_[l].at(step.problem.x.X);
    if (gap.cols() == 0 || (gap - last).cwiseAbs().maxCoeff() <= kSettled) return;
    shift += gap;
  }
}

// Eq. 9–11 and the scaling after them. Only the direction of the first edge of each fitted triangle
// is needed.
void GeneralSteps::fit(const Eigen::MatrixXd& intermediate) {
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

void GeneralSteps::update(const Eigen::Matrix2Xd& targets) {
  const Eigen::Matrix2Xd q = (targets.colwise() - origin_) / unit_;
  summary_ = {};
  summary_.status = Status::kConverged;
  seconds_ = {};
  translate_components(q);
  {
    Stopwatch watch(seconds_.step_one);
    solve_with_handles(similarity_, q);
  }
  {
    Stopwatch watch(seconds_.fit);
    fit(similarity_.problem.x.X);
  }
  {
    Stopwatch watch(seconds_.step_two);
    for (int i = 0; i <= refinements_; ++i) {
      if (i > 0) fit(edge_fit_.problem.x.X);
      edge_fit_.problem.terms.back().energy->set_targets(corners_);
      solve_with_handles(edge_fit_, q);
    }
  }
  V_ = to_lengths(edge_fit_.problem.x.X);
  summary_.seconds = seconds_.by_name();
}

}  // namespace deformlab
