#include "deformers/embedded/embedded_deformation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "deformers/embedded/handles/winding.h"
#include "deformers/embedded/node_states.h"
#include "deformers/embedded/reflections.h"
#include "deformers/handle_checks.h"
#include "geometry/core/error.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

void append(std::vector<std::string>& notes, const std::vector<std::string>& more) {
  notes.insert(notes.end(), more.begin(), more.end());
}

EmbeddedDeformationOptions checked(const EmbeddedDeformationOptions& options, const Shape& rest) {
  check(options, rest);
  return options;
}

std::unique_ptr<Solver> solver_of(const EmbeddedDeformationOptions& options) {
  return inside_option("solver", [&] { return make_solver(options.solver); });
}

}  // namespace

EmbeddedDeformation::EmbeddedDeformation(Shape rest, const EmbeddedDeformationOptions& options,
                                         std::span<const Cut> cuts)
    : options_(checked(options, rest)),
      rest_(std::move(rest)),
      cuts_(cuts.begin(), cuts.end()),
      solver_(solver_of(options)) {
  check_interior();
  if (options_.graph.region == NodeRegion::kActive) {
    check(rest_, "the shape");
    deformed_ = rest_;
    return;
  }
  register_graph(inside_option("graph", [&] { return build_graph(rest_, options_.graph, cuts_); }));
  compile({});
}

EmbeddedDeformation::EmbeddedDeformation(Shape rest, const Eigen::Matrix3Xd& nodes,
                                         const EmbeddedDeformationOptions& options,
                                         std::span<const Cut> cuts)
    : options_(checked(options, rest)), rest_(std::move(rest)), solver_(solver_of(options)) {
  options_.graph.region = NodeRegion::kWhole;  // no other graph is built
  check_interior();
  register_graph(
      inside_option("graph", [&] { return build_graph(rest_, nodes, options_.graph, cuts); }));
  compile({});
}

EmbeddedDeformation::EmbeddedDeformation(Shape rest, DeformationGraph graph,
                                         const EmbeddedDeformationOptions& options)
    : options_(checked(options, rest)), rest_(std::move(rest)), solver_(solver_of(options)) {
  options_.graph.region = NodeRegion::kWhole;  // no other graph is built
  check_interior();
  register_graph(
      inside_option("graph", [&] { return build_graph(rest_, std::move(graph), options_.graph); }));
  compile({});
}

void EmbeddedDeformation::register_graph(BuiltGraph built) {
  surface_graph_ = std::move(built.graph);
  embedding_ = std::move(built.embedding);
  node_vertices_ = std::move(built.node_vertices);
  active_ = std::move(built.active);
  in_space_ = built.in_space;
  registration_notes_ = std::move(built.notes);
  seconds_ = std::move(built.seconds);
  has_interior_ = false;
  set_graph(surface_graph_);
}

void EmbeddedDeformation::set_graph(DeformationGraph graph) {
  graph_ = std::move(graph);
  unit_ = deformlab::length_unit(options_.length_unit, graph_);
  const int m = static_cast<int>(graph_.g.cols());
  problem_.x = rest_states(m);
  problem_.fixed.assign(m, 0);
  satellite_owners_ = {};
  deformed_ = rest_;
  at_rest_ = true;
  compiled_ = false;
}

void EmbeddedDeformation::build_active_graph(const Handles& handles) {
  if (built_for_ == handles.fixed) return;
  register_graph(inside_option(
      "graph", [&] { return build_graph(rest_, options_.graph, cuts_, handles.fixed); }));
  built_for_ = handles.fixed;
}

void EmbeddedDeformation::reset() {
  problem_.x = rest_states(problem_.x.nodes());
  deformed_ = rest_;
  at_rest_ = true;
  compiled_ = false;  // the next compilation is for the state at rest
}

void EmbeddedDeformation::repose(const Shape& rest, const Eigen::Matrix3Xd& nodes) {
  if (rest.V.cols() != rest_.V.cols() || nodes.cols() != graph_.g.cols()) {
    throw InputError(fmt::format(
        "a pose of {} vertices and {} nodes does not fit a shape of {} vertices and {} nodes",
        rest.V.cols(), nodes.cols(), rest_.V.cols(), graph_.g.cols()));
  }
  check(rest, "the pose");
  if (!nodes.allFinite())
    throw InputError("a node of the pose is not finite; every number must be");
  check_dimension(options_.dimension, rest);
  rest_ = rest;
  embedding_.v = rest.V;
  graph_.g = nodes;
  surface_graph_.g = nodes.leftCols(surface_graph_.g.cols());
  reset();
}

Unknowns EmbeddedDeformation::rest_states(int m) const {
  return deformlab::rest_states(options_.node_model(), options_.dimension, m);
}

Transformations EmbeddedDeformation::transformations() const {
  return to_transformations(problem_.x, options_.node_model(), unit_);
}

void EmbeddedDeformation::begin_at(const Transformations& X) {
  if (X.cols() != 4 * graph_.g.cols()) {
    throw InputError(fmt::format("{} transformations do not fit a graph of {} nodes", X.cols() / 4,
                                 graph_.g.cols()));
  }
  for (Eigen::Index j = 0; j < graph_.g.cols(); ++j) {
    if (X.middleCols<4>(4 * j).allFinite()) continue;
    throw InputError(fmt::format(
        "the transformation of node {} (counted from 0) is not finite; every number must be", j));
  }
  set_transformations(X, options_.node_model(), unit_, problem_.fixed, problem_.x);
  at_rest_ = false;
  transfer(transformations());
}

void EmbeddedDeformation::transfer(const Transformations& X) {
  transfer_positions(X, graph_.g, embedding_, deformed_.V, options_.transfer_threads);
  for (const int i : fixed_) deformed_.V.col(i) = rest_.V.col(i);  // without rounding
  if (rest_.N.cols() == 0) return;
  transfer_normals(X, rest_.N, embedding_, deformed_.N, options_.transfer_threads);
}

Eigen::Matrix3Xd EmbeddedDeformation::points(const Transformations& X) const {
  return transfer_positions(X, graph_.g, handles_).middleCols(moved_ - points_, points_);
}

Eigen::Matrix3Xd EmbeddedDeformation::all_targets(const Eigen::Matrix3Xd& targets) const {
  Eigen::Matrix3Xd all = handles_.v;
  all.leftCols(moved_) = targets;
  all.rightCols(satellites_.count()) = satellites_.targets(targets);
  return all;
}

void EmbeddedDeformation::measure(const Transformations& X, const Eigen::Matrix3Xd& targets,
                                  Report& report) const {
  report.nodes = static_cast<int>(graph_.g.cols());
  report.edges = static_cast<int>(graph_.edges.size());
  report.length_unit = unit_;
  const Determinants det = determinants(X);
  report.min_det_R = det.least;
  report.inside_out = det.inside_out;
  measure_handles(transfer_positions(X, graph_.g, handles_).leftCols(moved_), targets, report);
  report.immovable = immovable_;
  report.advice = advice();
  if (auto lost = lost_turn(graph_, X, handles_, rotations_, nodes_at_rest())) {
    report.undone.push_back(std::move(*lost));
  }
  report.seconds.insert(seconds_.begin(), seconds_.end());
  report.seconds["solve"] = report.solve.seconds["total"];
}

// Names only options that are not yet as the advice wants them.
Advice EmbeddedDeformation::advice() const {
  const GraphOptions& graph = options_.graph;
  const std::string more = graph.method != NodePlacement::kFile
                               ? fmt::format("use more nodes with a greater graph.nodes (now {})",
                                             surface_graph_.g.cols())
                               : "use a graph file with more nodes";
  Advice advice;
  advice.missed = fmt::format(
      "{}, hold it more with a greater energies.constraint, or fix less around it", more);
  advice.torn = fmt::format("move the handles less, let more of the shape move, or {}", more);
  if (graph.distance != NodeDistance::kPathAware) {
    advice.open_seam += ", or take graph.distance=path_aware";
  }
  if (options_.reflections != Reflections::kRepair) {
    advice.inside_out += ", or set reflections=repair";
  }
  advice.immovable = fmt::format("fix fewer vertices, or {}", more);
  return advice;
}

// Notes are in the order of the phases: registration, compilation, solve.
void EmbeddedDeformation::add_notes(Report& report) const {
  std::vector<std::string> notes = registration_notes_;
  append(notes, report.notes);
  append(notes, compilation_notes_);
  append(notes, report.solve.notes);
  if (report.inside_out > 0) {
    notes.push_back(fmt::format(
        "nodes where space is turned inside out (det R < 0), which E_rot cannot see: {}; {}",
        report.inside_out, report.advice.inside_out));
  }
  report.notes = std::move(notes);
}

void EmbeddedDeformation::check_in_plane(const Eigen::Matrix3Xd& targets) const {
  if (options_.dimension == 3) return;
  const double same = 1e-9 * bounding_box_diagonal(rest_.V);
  for (Eigen::Index l = 0; l < targets.cols(); ++l) {
    const double along_z = targets(2, l) - handles_.v(2, l);
    if (std::abs(along_z) <= same) continue;
    throw OptionError("dimension", "2",
                      fmt::format(", but a handle at ({:.6g}, {:.6g}, {:.6g}) is moved by {:.6g} "
                                  "along z; use 3, or move it in the plane",
                                  handles_.v(0, l), handles_.v(1, l), handles_.v(2, l), along_z));
  }
}

Report EmbeddedDeformation::update(const Eigen::Matrix3Xd& targets) {
  if (graph_.g.cols() == 0) compile({});
  check_targets(targets, moved_);
  check_in_plane(targets);
  Report report;
  const Eigen::Matrix3Xd all = all_targets(targets);
  const Eigen::MatrixXd in_units = all.topRows(options_.dimension) / unit_;
  for (const WeightedEnergy& term : problem_.terms) term.energy->set_targets(in_units);
  begin(all);
  report.solve = solver_->solve(problem_);
  relax(all, report);
  at_rest_ = false;
  if (options_.reflections == Reflections::kRepair && options_.node_model() == NodeModel::kAffine) {
    repair_reflections(problem_, graph_, handles_, *solver_, options_.solver, report);
  }
  const Transformations X = transformations();
  {
    Stopwatch watch(report.seconds["transfer"]);
    transfer(X);
  }
  measure(X, targets, report);
  add_notes(report);
  return report;
}

}  // namespace deformlab
