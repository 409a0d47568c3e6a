#include "deformers/embedded/embedded_deformation.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <utility>

#include "deformers/embedded/node_states.h"
#include "deformers/embedded/reflections.h"
#include "deformers/handle_checks.h"
#include "geometry/core/error.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

DeformationGraph scaled(DeformationGraph graph, double factor) {
  graph.g *= factor;
  return graph;
}

Embedding scaled(Embedding embedding, double factor) {
  embedding.v *= factor;
  return embedding;
}

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
    : options_(checked(options, rest)), rest_(std::move(rest)), solver_(solver_of(options)) {
  register_graph(inside_option("graph", [&] { return build_graph(rest_, options_.graph, cuts); }));
}

EmbeddedDeformation::EmbeddedDeformation(Shape rest, const Eigen::Matrix3Xd& nodes,
                                         const EmbeddedDeformationOptions& options,
                                         std::span<const Cut> cuts)
    : options_(checked(options, rest)), rest_(std::move(rest)), solver_(solver_of(options)) {
  register_graph(
      inside_option("graph", [&] { return build_graph(rest_, nodes, options_.graph, cuts); }));
}

EmbeddedDeformation::EmbeddedDeformation(Shape rest, DeformationGraph graph,
                                         const EmbeddedDeformationOptions& options)
    : options_(checked(options, rest)), rest_(std::move(rest)), solver_(solver_of(options)) {
  register_graph(
      inside_option("graph", [&] { return build_graph(rest_, std::move(graph), options_.graph); }));
}

void EmbeddedDeformation::register_graph(BuiltGraph built) {
  graph_ = std::move(built.graph);
  embedding_ = std::move(built.embedding);
  node_vertices_ = std::move(built.node_vertices);
  in_space_ = built.in_space;
  registration_notes_ = std::move(built.notes);
  seconds_ = std::move(built.seconds);
  unit_ = deformlab::length_unit(options_.length_unit, graph_);
  const int m = static_cast<int>(graph_.g.cols());
  problem_.x = rest_states(m);
  problem_.fixed.assign(m, 0);
  deformed_ = rest_;
  compile({});
}

void EmbeddedDeformation::reset() {
  problem_.x = rest_states(problem_.x.nodes());
  deformed_ = rest_;
}

void EmbeddedDeformation::repose(const Shape& rest, const Eigen::Matrix3Xd& nodes) {
  if (rest.V.cols() != rest_.V.cols() || nodes.cols() != graph_.g.cols()) {
    throw InputError(fmt::format(
        "a pose of {} vertices and {} nodes does not fit a shape of {} vertices and {} nodes",
        rest.V.cols(), nodes.cols(), rest_.V.cols(), graph_.g.cols()));
  }
  check_dimension(options_.dimension, rest);
  rest_ = rest;
  embedding_.v = rest.V;
  graph_.g = nodes;
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
  set_transformations(X, options_.node_model(), unit_, problem_.fixed, problem_.x);
  transfer(transformations());
}

void EmbeddedDeformation::transfer(const Transformations& X) {
  transfer_positions(X, graph_.g, embedding_, deformed_.V, options_.transfer_threads);
  for (const int i : fixed_) deformed_.V.col(i) = rest_.V.col(i);  // without rounding
  if (rest_.N.cols() == 0) return;
  transfer_normals(X, rest_.N, embedding_, deformed_.N, options_.transfer_threads);
}

Eigen::Matrix3Xd EmbeddedDeformation::points(const Transformations& X) const {
  return transfer_positions(X, graph_.g, handles_).rightCols(points_);
}

// Sumner et al. 2007, Eq. 9: R_q = I, t_q = 0 for every node that influences a fixed vertex.
void EmbeddedDeformation::fix_nodes(const Handles& handles) {
  std::fill(problem_.fixed.begin(), problem_.fixed.end(), 0);
  for (const int i : handles.fixed) {
    for (Eigen::Index a = 0; a < embedding_.nodes.rows(); ++a) {
      if (embedding_.weights(a, i) > 0) problem_.fixed[embedding_.nodes(a, i)] = 1;
    }
  }
  const Eigen::MatrixXd rest = rest_states(1).X;
  for (int j = 0; j < problem_.x.nodes(); ++j) {
    const int first = problem_.x.first[j], columns = problem_.x.columns(j);
    if (problem_.fixed[j]) problem_.x.X.middleCols(first, columns) = rest;
  }
}

void EmbeddedDeformation::pin_components() {
  Pins pins = pin_free_components(graph_, handles_, bounding_box_diagonal(rest_.V), problem_.fixed);
  at_one_point_ = std::move(pins.at_one_point);
  compilation_notes_ = std::move(pins.notes);
  const int immovable = count_immovable(handles_, problem_.fixed);
  if (immovable == 0) return;
  compilation_notes_.push_back(
      fmt::format("handles that follow fixed nodes only and so cannot move: {}; fix fewer vertices "
                  "or use more nodes",
                  immovable));
}

void EmbeddedDeformation::make_terms() {
  const DeformationGraph graph = scaled(graph_, 1 / unit_);
  const Embedding handles = scaled(handles_, 1 / unit_);
  problem_.terms = deformlab::make_terms(options_, {.graph = graph,
                                                    .handles = handles,
                                                    .model = options_.node_model(),
                                                    .dimension = options_.dimension,
                                                    .shape = rest_,
                                                    .vertices = embedding_,
                                                    .unit = unit_});
}

void EmbeddedDeformation::compile(const Handles& handles) {
  seconds_["compile"] = 0;
  Stopwatch watch(seconds_["compile"]);
  check_handles(handles, rest_.V.cols());
  fixed_ = handles.fixed;
  points_ = handles.points.cols();
  handles_ = joined(subset(embedding_, handles.moved),
                    in_space_ ? embed(handles.points, graph_.g, options_.graph.neighbors)
                              : embed_at_vertices(handles.points, embedding_));
  fix_nodes(handles);
  pin_components();
  make_terms();
  solver_->compile(problem_);
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

void EmbeddedDeformation::measure(const Transformations& X, const Eigen::Matrix3Xd& targets,
                                  Report& report) const {
  report.nodes = static_cast<int>(graph_.g.cols());
  report.edges = static_cast<int>(graph_.edges.size());
  report.length_unit = unit_;
  report.min_det_R = std::numeric_limits<double>::infinity();
  for (Eigen::Index j = 0; j < graph_.g.cols(); ++j) {
    const double det = X.middleCols<3>(4 * j).determinant();
    report.min_det_R = std::min(report.min_det_R, det);
    report.inside_out += det < 0;
  }
  measure_handles(transfer_positions(X, graph_.g, handles_), targets, report);
  report.seconds.insert(seconds_.begin(), seconds_.end());
  report.seconds["solve"] = report.solve.seconds["total"];
}

// Notes are in the order of the phases: registration, compilation, solve.
void EmbeddedDeformation::add_notes(Report& report) const {
  std::vector<std::string> notes = registration_notes_;
  append(notes, report.notes);
  append(notes, compilation_notes_);
  append(notes, report.solve.notes);
  if (report.inside_out > 0) {
    notes.push_back(fmt::format(
        "nodes where space is turned inside out (det R < 0), which E_rot cannot see: {}; move the "
        "handles less, or in smaller steps{}",
        report.inside_out,
        options_.reflections == Reflections::kRepair ? "" : ", or set reflections: repair"));
  }
  report.notes = std::move(notes);
}

Report EmbeddedDeformation::update(const Eigen::Matrix3Xd& targets) {
  check_targets(targets, handles_.v.cols());
  Report report;
  const Eigen::MatrixXd in_units = targets.topRows(options_.dimension) / unit_;
  for (const WeightedEnergy& term : problem_.terms) term.energy->set_targets(in_units);
  translate_pinned(targets);
  report.solve = solver_->solve(problem_);
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
