#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "deformers/embedded/embedded_deformation.h"
#include "deformers/embedded/handles/border.h"
#include "deformers/handle_checks.h"
#include "solvers/stopwatch.h"

// Compilation: what depends on the handles, but not on their targets.
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

bool have_same_nodes(const Embedding& a, const Embedding& b) {
  const bool same_size = a.nodes.rows() == b.nodes.rows() && a.nodes.cols() == b.nodes.cols();
  return same_size && a.nodes == b.nodes && a.weights == b.weights;
}

}  // namespace

void EmbeddedDeformation::fix_nodes(const std::vector<char>& fixed) {
  problem_.fixed = fixed;
  const Eigen::MatrixXd rest = rest_states(1).X;
  for (int j = 0; j < problem_.x.nodes(); ++j) {
    const int first = problem_.x.first[j], columns = problem_.x.columns(j);
    if (problem_.fixed[j]) problem_.x.X.middleCols(first, columns) = rest;
  }
}

Embedding EmbeddedDeformation::embedded_points(const Eigen::Matrix3Xd& points) const {
  if (in_space_) return embed(points, surface_graph_.g, options_.graph.neighbors);
  if (active_.empty()) return embed_at_vertices(points, embedding_);
  return embed_at_vertices(points, subset(embedding_, active_));
}

void EmbeddedDeformation::embed_handles(const Handles& handles) {
  points_ = handles.points.cols();
  moved_ = handles.targets();
  rotations_ = handles.rotations;
  groups_ = handles.groups;
  fixed_ = handles.fixed;
  const Embedding points = embedded_points(handles.points);
  handles_ = joined(subset(embedding_, handles.moved), points);
  const FixedPart part{embedding_, active_, fixed_};
  fix_nodes(fixed_nodes(part, points, options_.border, graph_.g.cols()));
  if (options_.border == Border::kSoft) {
    handles_ = joined(handles_, subset(embedding_, border_vertices(part, problem_.fixed)));
  }
  embed_satellites(handles);
}

// In the plane, every handle that turns has a ring of points instead.
void EmbeddedDeformation::embed_satellites(const Handles& handles) {
  satellites_ = {};
  if (options_.hold_angles && options_.dimension == 3) {
    satellites_ = make_satellites(handles_.v.leftCols(moved_), rotations_, groups_, unit_);
  }
  const Embedding owners = subset(handles_, satellites_.handles);
  const Eigen::Matrix3Xd places = satellites_.places(handles_.v);
  // While the handles stay and only the pose changes, satellites follow the same nodes, so that an
  // animation does not flicker.
  if (have_same_nodes(owners, satellite_owners_)) {
    satellite_places_.v = places;
  } else {
    satellite_places_ = embedded_points(places);
    satellite_owners_ = owners;
  }
  handles_ = joined(handles_, satellite_places_);
  handle_weights_ = {};
  if (handles.weights.size() == 0) return;
  handle_weights_ = Eigen::VectorXd::Ones(handles_.v.cols());
  handle_weights_.head(moved_) = handles.weights;
  handle_weights_.tail(satellites_.count()) = handles.weights(satellites_.handles);
}

Eigen::VectorXd EmbeddedDeformation::node_stiffness() const {
  if (options_.stiffness.size() == 0) return {};
  Eigen::VectorXd result = Eigen::VectorXd::Zero(graph_.g.cols());
  for (Eigen::Index c = 0; c < embedding_.nodes.cols(); ++c) {
    for (Eigen::Index a = 0; a < embedding_.nodes.rows(); ++a) {
      if (!(embedding_.weights(a, c) > 0)) continue;
      double& stiffness = result[embedding_.nodes(a, c)];
      stiffness = std::max(stiffness, options_.stiffness[c]);
    }
  }
  return (result.array() > 0).select(result, 1);
}

// Those that are fixed, and those nearest to the fixed vertices of a soft border.
std::vector<char> EmbeddedDeformation::nodes_at_rest() const {
  std::vector<char> at_rest = problem_.fixed;
  for (Eigen::Index l = moved_; l < handles_.v.cols() - satellites_.count(); ++l) {
    at_rest[handles_.nodes(0, l)] = 1;
  }
  return at_rest;
}

void EmbeddedDeformation::pin_components() {
  Pins pins = pin_free_components(graph_, handles_, bounding_box_diagonal(rest_.V),
                                  options_.dimension, problem_.fixed);
  at_one_point_ = std::move(pins.at_one_point);
  on_one_line_ = std::move(pins.on_one_line);
  compilation_notes_ = std::move(pins.notes);
  immovable_ = count_immovable(handles_, moved_, problem_.fixed);
  if (immovable_ == 0) return;
  compilation_notes_.push_back(
      fmt::format("handles that follow fixed nodes only and so cannot move: {}; fix fewer vertices "
                  "or use more nodes",
                  immovable_));
}

// Calls make(context) with what terms are summed over.
template <class Make>
void EmbeddedDeformation::with_context(Make&& make) const {
  const DeformationGraph graph = scaled(graph_, 1 / unit_);
  const Embedding handles = scaled(handles_, 1 / unit_);
  const Eigen::VectorXd stiffness = node_stiffness();
  make(GraphContext{.graph = graph,
                    .handles = handles,
                    .model = options_.node_model(),
                    .dimension = options_.dimension,
                    .shape = rest_,
                    .vertices = embedding_,
                    .unit = unit_,
                    .handle_weights = handle_weights_,
                    .stiffness = stiffness});
}

void EmbeddedDeformation::make_terms() {
  recipes_ = term_recipes(options_);
  reads_handles_.clear();
  problem_.terms.clear();
  with_context([&](const GraphContext& context) {
    for (const TermRecipe& recipe : recipes_) {
      context.handles.forget();
      problem_.terms.push_back({recipe.make(context), recipe.weight, recipe.loss});
      reads_handles_.push_back(context.handles.were_read());
    }
  });
}

// Adapts the compiled problem to handles that were added or removed. Returns false if it has to be
// compiled again.
bool EmbeddedDeformation::change_handles(const std::vector<char>& fixed_before) {
  if (!compiled_ || problem_.fixed != fixed_before) return false;
  bool adapted = true;
  with_context([&](const GraphContext& context) {
    for (std::size_t i = 0; i < recipes_.size() && adapted; ++i) {
      if (!reads_handles_[i]) continue;
      problem_.terms[i].energy = recipes_[i].make(context);
      adapted = solver_->change_elements(problem_, i);
    }
  });
  return adapted;
}

void EmbeddedDeformation::compile(const Handles& handles) {
  check_handles(handles, rest_.V.cols());
  // This replaces seconds_, so that it comes before the watch.
  if (options_.graph.region == NodeRegion::kActive) build_active_graph(handles);
  seconds_["compile"] = 0;
  Stopwatch watch(seconds_["compile"]);
  const std::vector<char> fixed_before = problem_.fixed;
  embed_handles(handles);
  if (fit_interior()) embed_handles(handles);
  pin_components();
  if (change_handles(fixed_before)) return;
  compiled_ = false;
  make_terms();
  solver_->compile(problem_);
  compiled_ = true;
  ++compilations_;
}

}  // namespace deformlab
