#include "experiments/subjects/drawing/drawing_pictures.h"

#include <algorithm>

namespace deformlab {
namespace {

constexpr int kPanelWidth =
    420;  // replaces the default of picture.width, which is for shapes [pixel]

// The positions of pinned vertices, then of handles, 2×p.
Eigen::Matrix2Xd handle_positions(const ResolvedEdit& edit, const Eigen::Matrix2Xd& V,
                                  bool at_rest) {
  const std::vector<int>&fixed = edit.handles.fixed, &moved = edit.handles.moved;
  const Eigen::Matrix3Xd& points = edit.handles.points;
  Eigen::Matrix2Xd result(2, std::ssize(fixed) + edit.targets.cols());
  result.leftCols(std::ssize(fixed)) = V(Eigen::all, fixed);
  if (at_rest) {
    result.middleCols(std::ssize(fixed), std::ssize(moved)) = V(Eigen::all, moved);
    result.rightCols(points.cols()) = points.topRows<2>();
  } else {
    result.rightCols(edit.targets.cols()) = edit.targets.topRows<2>();
  }
  return result;
}

}  // namespace

void DrawingBook::add_rest(const PicturedDrawing& pictured) {
  if (!options_.rest) return;
  DrawingPanel panel;
  panel.V = pictured.bound->rest().V;
  panel.edges = options_.graph != PicturedGraph::kNone;
  panel.tint = (pictured.weights.array() != 1).cast<double>();
  panel.handles = handle_positions(pictured.edit, panel.V, true);
  panel.caption = "rest shape";
  add(pictured, std::move(panel));
}

void DrawingBook::add_deformed(const PicturedDrawing& pictured, const Eigen::Matrix2Xd& V,
                               const Eigen::VectorXd& depth, const std::string& caption) {
  DrawingPanel panel;
  panel.V = V;
  panel.depth = depth;
  panel.edges = options_.graph == PicturedGraph::kAll;
  panel.handles = handle_positions(pictured.edit, V, false);
  panel.caption = caption;
  add(pictured, std::move(panel));
}

void DrawingBook::add_steps(const PicturedDrawing& pictured, const Eigen::Matrix2Xd& intermediate,
                            const Eigen::Matrix2Xd& fitted) {
  add_deformed(pictured, intermediate, {}, "step one: intermediate");
  panels_.back().panel.edges = true;
  add_deformed(pictured, intermediate, {}, "fitted triangles");
  panels_.back().panel.loose = fitted;
}

void DrawingBook::add(const PicturedDrawing& pictured, DrawingPanel panel) {
  panels_.push_back({pictured.bound, std::move(panel), pictured.drawn_on, pictured.page});
}

// What the panels of all drawings on such a page show, so that these can be compared. A drawing on
// another page is another one, and fills its own panels.
Page DrawingBook::frame_for(const Page& drawn_on) const {
  Page frame;
  for (const Entry& entry : panels_) {
    if (!entry.drawn_on.isApprox(drawn_on, 0)) continue;
    frame.extend(entry.page ? *entry.page : frame_of(*entry.bound, {entry.panel}));
  }
  return frame;
}

Image DrawingBook::render() const {
  const int width = options_.width == PictureOptions{}.width ? kPanelWidth : options_.width;
  std::vector<Image> images;
  for (const Entry& entry : panels_) {
    images.push_back(draw_panel(*entry.bound, entry.panel, frame_for(entry.drawn_on), width));
  }
  const int columns = options_.columns > 0 ? options_.columns : 4;
  return grid(images, std::min(columns, static_cast<int>(images.size())));
}

}  // namespace deformlab
