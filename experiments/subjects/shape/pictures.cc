#include "experiments/subjects/shape/pictures.h"

#include <algorithm>
#include <array>

namespace deformlab {
namespace {

constexpr double kNodeShare =
    0.03;  // part of a mean edge, so that nodes of a dense graph are smaller
constexpr std::size_t kMostHandleBalls = 60;  // if there are more, a tint shows them better

// Draws a square at each deformed node, which is upright along x at rest, as its R_j deforms it:
// the quadrilaterals of Sumner et al. 2007, Figure 2.
void add_frames(Panel& panel, const DeformationGraph& graph, const Transformations& X,
                double half) {
  const std::array<Eigen::Vector3d, 4> corners{
      Eigen::Vector3d(half, 0, half), {-half, 0, half}, {-half, 0, -half}, {half, 0, -half}};
  for (Eigen::Index j = 0; j < graph.g.cols(); ++j) {
    const Eigen::Vector3d center = graph.g.col(j) + X.col(4 * j + 3);
    for (int c = 0; c < 4; ++c) {
      const Eigen::Vector3d a = center + X.middleCols<3>(4 * j) * corners[c];
      const Eigen::Vector3d b = center + X.middleCols<3>(4 * j) * corners[(c + 1) % 4];
      panel.sticks.push_back({a, b, half / 12, colors::kTarget});
    }
  }
}

Eigen::Matrix3Xd deformed_nodes(const DeformationGraph& graph, const Transformations& X) {
  Eigen::Matrix3Xd places = graph.g;
  for (Eigen::Index j = 0; j < places.cols(); ++j) places.col(j) += X.col(4 * j + 3);
  return places;
}

}  // namespace

void PictureBook::add(const Shape& shape, const ResolvedEdit& edit, const Eigen::Matrix3Xd& points,
                      const std::string& caption) {
  shapes_.push_back(std::make_unique<Shape>(shape));
  Panel panel{.shape = shapes_.back().get(), .caption = caption, .camera = camera_};
  const double size = bounding_box_diagonal(shape.V);
  panel.vertex_colors = tinted(shape, edit.handles.fixed);
  const auto& moved = edit.handles.moved;
  if (moved.size() > kMostHandleBalls) {
    for (const int i : moved) panel.vertex_colors.col(i) = colors::kHandle;
  } else {
    add_balls(panel, shape.V(Eigen::all, moved), kHandleRadius * size, colors::kHandle);
  }
  add_balls(panel, points, kHandleRadius * size, colors::kHandle);
  panels_.push_back(std::move(panel));
}

// Adds the graph to the last panel.
void PictureBook::add_graph(const EmbeddedDeformation& deformer, const Transformations& X) {
  Panel& panel = panels_.back();
  const DeformationGraph& graph = deformer.graph();
  const double size = bounding_box_diagonal(panel.shape->V), edge = mean_edge_length(graph);
  if (options_.graph == PicturedGraph::kAll ||
      (options_.graph == PicturedGraph::kRest && panels_.size() == 1 && options_.rest)) {
    deformlab::add_graph(panel, graph, deformed_nodes(graph, X),
                         std::min(kNodeRadius * size, kNodeShare * edge));
  }
  if (options_.frames) add_frames(panel, graph, X, 0.25 * edge);
}

void PictureBook::add_rest(const Deformer& deformer, const Shape& rest, const ResolvedEdit& edit) {
  if (!options_.rest) return;
  add(rest, edit, edit.handles.points, "rest shape");
  if (const auto* embedded = as_embedded(deformer)) {
    add_graph(*embedded, rest_transformations(embedded->graph().g.cols()));
  }
}

void PictureBook::add_deformed(const Deformer& deformer, const ResolvedEdit& edit,
                               const std::string& caption) {
  const auto* embedded = as_embedded(deformer);
  const Eigen::Matrix3Xd targets = edit.targets.rightCols(edit.handles.points.cols());
  add(deformer.deformed(), edit, embedded ? embedded->points(embedded->transformations()) : targets,
      caption);
  if (embedded) add_graph(*embedded, embedded->transformations());
}

Image PictureBook::render() const {
  const RenderOptions options = render_options(options_);
  const int wanted = options_.columns > 0 ? options_.columns : panels_.size() <= 2 ? 2 : 4;
  const int columns = std::min<int>(wanted, static_cast<int>(panels_.size()));
  return render_grid(panels_, options, columns);
}

}  // namespace deformlab
