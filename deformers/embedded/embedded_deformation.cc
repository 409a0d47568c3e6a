#include "deformers/embedded/embedded_deformation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "deformers/embedded/pins.h"
#include "deformers/embedded/reflections.h"
#include "deformers/handle_checks.h"
#include "energies/catalog.h"
#include "energies/graph/rotation.h"
#include "energies/graph/rotation_vector.h"
#include "geometry/core/error.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr double kMostUnits = 1e9;  // of length_unit in a mean edge, and of mean edges in it

double length_unit(const std::string& text, const DeformationGraph& graph) {
  if (text == "mean_edge") return mean_edge_length(graph);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool positive = error == std::errc() && end == text.data() + text.size() && value > 0;
  if (!positive || !std::isfinite(value)) {
    throw InputError("length_unit is '" + text + "'; it is mean_edge or a positive number");
  }
  const double edge = mean_edge_length(graph);
  if (value >= edge / kMostUnits && value <= edge * kMostUnits) return value;
  std::ostringstream message;
  message << "length_unit is '" << text << "', but the mean edge of the graph is " << edge
          << "; choose one within a factor of " << kMostUnits << " of it";
  throw InputError(message.str());
}

DeformationGraph scaled(DeformationGraph graph, double factor) {
  graph.g *= factor;
  return graph;
}

Embedding scaled(Embedding embedding, double factor) {
  embedding.v *= factor;
  return embedding;
}

void check_name(const std::string& energy) {
  const auto& known = known_energies();
  const bool found =
      std::any_of(known.begin(), known.end(), [&](const auto& e) { return e.name == energy; });
  if (!found) make_energy(energy, {}, {});  // says which names there are
}

void check_energies(const EmbeddedDeformationOptions& options) {
  for (const auto& [name, weight] : options.energies) {
    check_name(name);
    if (!(weight >= 0 && std::isfinite(weight))) {
      throw InputError("energies." + name + " is " + std::to_string(weight) +
                       "; a weight is a number of 0 or more");
    }
  }
  for (const auto& [name, loss] : options.losses) {
    check_name(name);
    make_loss(loss, "losses." + name);
  }
}

void check_dimension(int d, const Shape& rest) {
  if (d != 2 && d != 3) {
    throw InputError("dimension is " + std::to_string(d) + "; it is 3, or 2 for a flat shape");
  }
  if (d == 2 && rest.V.cols() > 0 && rest.V.row(2).maxCoeff() > rest.V.row(2).minCoeff()) {
    throw InputError("dimension is 2, but z differs over the shape; use 3, or flatten it");
  }
}

void check_reflections(const std::string& name) {
  if (name == "report" || name == "repair") return;
  throw InputError("unknown reflections '" + name + "'; known: report, repair");
}

// E_rot of a rotation is nothing, whatever its weight; every other term has to have its rigid form.
void check_rotation_model(const EmbeddedDeformationOptions& o) {
  if (o.rotation_model == "affine") return;
  if (o.rotation_model != "rigid") {
    throw InputError("unknown rotation_model '" + o.rotation_model + "'; known: affine, rigid");
  }
  if (o.dimension != 3) {
    throw InputError("rotation_model is rigid, which is for shapes in space, but dimension is " +
                     std::to_string(o.dimension) + "; use rotation_model: affine");
  }
  const auto& known = known_rigid_energies();
  for (const auto& [name, weight] : o.energies) {
    const bool found =
        std::any_of(known.begin(), known.end(), [&](const auto& e) { return e.name == name; });
    if (found || weight == 0 || name == Rotation<3>::kName) continue;
    throw InputError("energies." + name + " is " + std::to_string(weight) +
                     ", but rotation_model: rigid has no such term; make it 0, or use "
                     "rotation_model: affine");
  }
}

void check(const EmbeddedDeformationOptions& options, const Shape& rest) {
  check_energies(options);
  check_dimension(options.dimension, rest);
  check_reflections(options.reflections);
  check_rotation_model(options);
  if (options.graph.adaptive.start != 0) {
    throw InputError("graph.adaptive.start is " + std::to_string(options.graph.adaptive.start) +
                     ", but this graph is made once and stays, as that of an animation does; make "
                     "it 0");
  }
}

}  // namespace

EmbeddedDeformation::EmbeddedDeformation(Shape rest, const EmbeddedDeformationOptions& options,
                                         std::span<const Cut> cuts)
    : options_(options), rest_(std::move(rest)), solver_(make_solver(options.solver)) {
  check(options_, rest_);
  register_graph(build_graph(rest_, options_.graph, cuts));
}

EmbeddedDeformation::EmbeddedDeformation(Shape rest, const Eigen::Matrix3Xd& nodes,
                                         const EmbeddedDeformationOptions& options,
                                         std::span<const Cut> cuts)
    : options_(options), rest_(std::move(rest)), solver_(make_solver(options.solver)) {
  check(options_, rest_);
  register_graph(build_graph(rest_, nodes, options_.graph, cuts));
}

EmbeddedDeformation::EmbeddedDeformation(Shape rest, DeformationGraph graph,
                                         const EmbeddedDeformationOptions& options)
    : options_(options), rest_(std::move(rest)), solver_(make_solver(options.solver)) {
  check(options_, rest_);
  register_graph(build_graph(rest_, std::move(graph), options_.graph));
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
  problem_.x = Unknowns::uniform(rest_unknowns(m), m);
  problem_.fixed.assign(m, 0);
  deformed_ = rest_;
  compile({});
}

void EmbeddedDeformation::reset() {
  problem_.x.X = rest_unknowns(problem_.x.nodes());
  deformed_ = rest_;
}

void EmbeddedDeformation::repose(const Shape& rest, const Eigen::Matrix3Xd& nodes) {
  if (rest.V.cols() != rest_.V.cols() || nodes.cols() != graph_.g.cols()) {
    throw InputError("a pose of " + std::to_string(rest.V.cols()) + " vertices and " +
                     std::to_string(nodes.cols()) + " nodes is none of a shape of " +
                     std::to_string(rest_.V.cols()) + " and " + std::to_string(graph_.g.cols()));
  }
  check_dimension(options_.dimension, rest);
  rest_ = rest;
  embedding_.v = rest.V;
  graph_.g = nodes;
  reset();
}

// R_j = I, t_j = 0, side by side.
Eigen::MatrixXd EmbeddedDeformation::rest_unknowns(int m) const {
  if (is_rigid()) return Eigen::MatrixXd::Zero(3, 2 * m);
  const int d = options_.dimension;
  return Eigen::MatrixXd::Identity(d, d + 1).replicate(1, m);
}

Transformations EmbeddedDeformation::transformations() const {
  const int d = options_.dimension;
  Transformations X = rest_transformations(problem_.x.nodes());
  for (int j = 0; j < problem_.x.nodes(); ++j) {
    const auto node = problem_.x.X.middleCols(problem_.x.first[j], problem_.x.columns(j));
    if (is_rigid()) {
      for (int a = 0; a < 3; ++a) {
        X.col(4 * j + a) = turned<double>(node.col(0), Eigen::Vector3d::Unit(a));
      }
      X.col(4 * j + 3) = unit_ * node.col(1);
      continue;
    }
    X.block(0, 4 * j, d, d) = node.leftCols(d);
    X.block(0, 4 * j + 3, d, 1) = unit_ * node.col(d);
  }
  return X;
}

void EmbeddedDeformation::begin_at(const Transformations& X) {
  if (X.cols() != 4 * graph_.g.cols()) {
    throw InputError("transformations of " + std::to_string(X.cols() / 4) +
                     " nodes are none of a graph of " + std::to_string(graph_.g.cols()));
  }
  const int d = options_.dimension;
  for (int j = 0; j < problem_.x.nodes(); ++j) {
    if (problem_.fixed[j]) continue;
    auto node = problem_.x.X.middleCols(problem_.x.first[j], problem_.x.columns(j));
    node.rightCols<1>() = X.col(4 * j + 3).head(d) / unit_;
    if (is_rigid()) {
      const Eigen::AngleAxisd turn(nearest_rotation(X.middleCols<3>(4 * j)));
      node.col(0) = turn.angle() * turn.axis();
    } else {
      node.leftCols(d) = X.block(0, 4 * j, d, d);
    }
  }
  transfer(transformations());
}

void EmbeddedDeformation::transfer(const Transformations& X) {
  transfer_positions(X, graph_.g, embedding_, deformed_.V, options_.solver.threads);
  for (const int i : fixed_) deformed_.V.col(i) = rest_.V.col(i);  // free of rounding
  if (rest_.N.cols() == 0) return;
  transfer_normals(X, rest_.N, embedding_, deformed_.N, options_.solver.threads);
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
  for (int j = 0; j < problem_.x.nodes(); ++j) {
    const int first = problem_.x.first[j], columns = problem_.x.columns(j);
    if (problem_.fixed[j]) problem_.x.X.middleCols(first, columns) = rest_unknowns(1);
  }
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
  Pins holds =
      hold_free_components(graph_, handles_, bounding_box_diagonal(rest_.V), problem_.fixed);
  at_one_point_ = std::move(holds.at_one_point);
  compilation_notes_ = std::move(holds.notes);
  if (const int immovable = count_immovable(handles_, problem_.fixed); immovable > 0) {
    compilation_notes_.push_back(
        "handles that follow fixed nodes only and so cannot move: " + std::to_string(immovable) +
        "; fix fewer vertices or use more nodes");
  }

  const DeformationGraph graph = scaled(graph_, 1 / unit_);
  const Embedding embedded = scaled(handles_, 1 / unit_);
  problem_.terms.clear();
  for (const EnergyInfo& info : is_rigid() ? known_rigid_energies() : known_energies()) {
    const auto named = options_.energies.find(info.name);
    const double weight = named != options_.energies.end() ? named->second : info.default_weight;
    if (!(weight > 0)) continue;
    auto energy = is_rigid() ? make_rigid_energy(info.name, graph, embedded)
                             : make_energy(info.name, graph, embedded, options_.dimension);
    const auto robust = options_.losses.find(info.name);
    problem_.terms.push_back({std::move(energy), weight,
                              robust == options_.losses.end()
                                  ? nullptr
                                  : make_loss(robust->second, "losses." + info.name)});
  }
  solver_->compile(problem_);
}

// A part held at one point may turn about it at no cost. It starts where its handle takes it
// without turning, which is then a minimum: one handle is a translation.
void EmbeddedDeformation::carry_along(const Eigen::Matrix3Xd& targets) {
  if (at_one_point_.empty()) return;
  const int d = options_.dimension;
  const Eigen::Matrix3Xd reached = transfer_positions(transformations(), graph_.g, handles_);
  for (const PointPin& part : at_one_point_) {
    const Eigen::Matrix3Xd motion = (targets - reached)(Eigen::all, part.handles);
    const Eigen::Vector3d t = motion.rowwise().mean() / unit_;
    for (const int j : part.nodes) problem_.x.X.col(problem_.x.first[j + 1] - 1) += t.head(d);
  }
}

void EmbeddedDeformation::measure_determinants(const Transformations& X, Report& report) const {
  report.min_det_R = std::numeric_limits<double>::infinity();
  for (Eigen::Index j = 0; j < graph_.g.cols(); ++j) {
    const double det = X.middleCols<3>(4 * j).determinant();
    report.min_det_R = std::min(report.min_det_R, det);
    report.inside_out += det < 0;
  }
}

Report EmbeddedDeformation::update(const Eigen::Matrix3Xd& targets) {
  check_targets(targets, handles_.v.cols());
  Report report;
  const Eigen::MatrixXd aims = targets.topRows(options_.dimension) / unit_;
  for (const auto& term : problem_.terms) term.energy->set_targets(aims);
  carry_along(targets);
  report.solve = solver_->solve(problem_);
  if (options_.reflections == "repair" && !is_rigid()) {
    repair_reflections(problem_, graph_, handles_, *solver_, options_.solver, report);
  }
  const Transformations X = transformations();
  {
    Stopwatch watch(report.seconds["transfer"]);
    transfer(X);
  }
  report.nodes = static_cast<int>(graph_.g.cols());
  report.edges = static_cast<int>(graph_.edges.size());
  report.length_unit = unit_;
  measure_determinants(X, report);
  measure_handles(transfer_positions(X, graph_.g, handles_), targets, report);
  report.seconds.insert(seconds_.begin(), seconds_.end());
  report.seconds["solve"] = report.solve.seconds["total"];
  report.notes.insert(report.notes.begin(), registration_notes_.begin(), registration_notes_.end());
  for (const auto* notes : {&compilation_notes_, &report.solve.notes}) {
    report.notes.insert(report.notes.end(), notes->begin(), notes->end());
  }
  if (report.inside_out > 0) {
    report.notes.push_back(
        "nodes where space is turned inside out (det R < 0), which E_rot cannot see: " +
        std::to_string(report.inside_out) + "; move the handles less, or in smaller steps" +
        (options_.reflections == "repair" ? "" : ", or set reflections: repair"));
  }
  return report;
}

}  // namespace deformlab
