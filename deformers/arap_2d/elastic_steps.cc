#include "deformers/arap_2d/elastic_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "deformers/arap_2d/component_motion.h"
#include "energies/elastic_catalog.h"
#include "energies/triangle/point_constraint.h"
#include "geometry/core/error.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

// The weight of a point_constraint, as a multiple of the elastic weights of its surroundings.
constexpr double kConstraintWeight = 1e6;

bool is_vertex(const BarycentricPoint& point) { return point.b.maxCoeff() == 1; }

}  // namespace

bool ElasticOptions::is_used() const {
  return std::ranges::any_of(energies, [](const auto& term) { return term.second > 0; });
}

void check_elastic(const ElasticOptions& options) {
  for (const auto& [name, weight] : options.energies) {
    elastic_term(name);
    if (weight >= 0 && std::isfinite(weight)) continue;
    throw OptionError(fmt::format("energies.{}", name), fmt::format("{}", weight),
                      "; a weight is a number of at least 0");
  }
  for (const auto& [name, loss] : options.losses) elastic_term(name);
}

ElasticSteps::ElasticSteps(std::unique_ptr<TwoStepSolver> two_steps, const Triangulation& mesh,
                           const Eigen::VectorXd& weights, const ElasticOptions& options)
    : two_steps_(std::move(two_steps)),
      weights_(weights),
      options_(options),
      unit_(mean_edge_length(mesh)),
      origin_(mesh.V.rowwise().mean()),
      solver_(make_solver(options.solver)) {
  mesh_ = {(mesh.V.colwise() - origin_) / unit_, mesh.F};
  components_ = components(mesh_);
  problem_.x = Unknowns::uniform(mesh_.V, static_cast<int>(mesh_.V.cols()));
  V_ = mesh.V;
}

// Vertices of components that have handles at fewer than two positions, and vertices with handles.
void ElasticSteps::fix_vertices(const std::vector<BarycentricPoint>& points) {
  const Eigen::VectorXcd p = all_to_complex(mesh_.V);
  const double extent = extent_of(p);
  problem_.fixed.assign(static_cast<std::size_t>(mesh_.V.cols()), 0);
  for (const MeshComponent& component : components_) {
    std::vector<BarycentricPoint> own;
    for (const int i : points_inside(component, points)) own.push_back(points[i]);
    if (motion_of(!own.empty(), are_distinct(own, p, extent)) == ComponentMotion::kDeformation)
      continue;
    for (const int v : component.vertices) problem_.fixed[v] = 1;
  }
  held_.clear();
  for (int i = 0; i < std::ssize(points); ++i) {
    if (is_vertex(points[i])) {
      Eigen::Index corner = 0;
      points[i].b.maxCoeff(&corner);
      problem_.fixed[points[i].vertices[corner]] = 1;
    } else {
      held_.push_back(i);
    }
  }
}

void ElasticSteps::compile(const std::vector<BarycentricPoint>& points) {
  two_steps_->compile(points);
  notes_ = two_steps_->notes();
  fix_vertices(points);
  std::vector<BarycentricPoint> held;
  for (const int i : held_) held.push_back(points[i]);
  double sum = 0;
  problem_.terms.clear();
  oriented_.clear();
  for (const auto& [name, weight] : options_.energies) {
    if (!(weight > 0)) continue;
    const ElasticTerm& term = elastic_term(name);
    if (term.needs_orientation) oriented_ = name;
    const auto loss = options_.losses.find(name);
    problem_.terms.push_back({term.make(mesh_, weights_), weight,
                              loss == options_.losses.end() ? nullptr : make_loss(loss->second)});
    sum += weight;
  }
  problem_.terms.push_back({to_energy(PointConstraint::over(mesh_, held)),
                            kConstraintWeight * sum * weights_.maxCoeff()});
  solver_->compile(problem_);
  ++compilations_;
}

int ElasticSteps::count_inside_out() const {
  const Eigen::Matrix2Xd V = problem_.x.X;
  int count = 0;
  for (const auto f : mesh_.F.colwise())
    count += !(signed_area(V, f) / signed_area(mesh_.V, f) > 0);
  return count;
}

void ElasticSteps::update(const Eigen::Matrix2Xd& targets) {
  two_steps_->update(targets);
  V_ = two_steps_->positions();
  Summary before = two_steps_->summary();
  if (!V_.allFinite() || before.status == Status::kFailed) {
    summary_ = std::move(before);
    return;
  }
  double seconds = 0;
  {
    Stopwatch watch(seconds);
    problem_.x.X = (V_.colwise() - origin_) / unit_;
    problem_.terms.back().energy->set_targets((targets(Eigen::all, held_).colwise() - origin_) /
                                              unit_);
    const int inside_out = oriented_.empty() ? 0 : count_inside_out();
    if (inside_out > 0) {
      summary_ = std::move(before);
      summary_.status = Status::kFailed;
      summary_.message = fmt::format(
          "{} triangles are inside out after the two steps, where {} cannot begin; move the "
          "handles less, or take arap instead",
          inside_out, oriented_);
      return;
    }
    summary_ = solver_->solve(problem_);
  }
  V_ = (unit_ * problem_.x.X).colwise() + origin_;
  for (const auto& [phase, time] : before.seconds) {
    if (phase != "total") summary_.seconds[phase] = time;
  }
  summary_.seconds["total"] = before.seconds["total"] + seconds;
}

void ElasticSteps::reset() {
  two_steps_->reset();
  V_ = two_steps_->positions();
}

}  // namespace deformlab
