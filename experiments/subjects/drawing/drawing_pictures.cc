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

DrawingPanel DrawingBook::deformed_panel(const PicturedDrawing& pictured, const Eigen::Matrix2Xd& V,
                                         const Eigen::VectorXd& depth,
                                         const std::string& caption) const {
  DrawingPanel panel;
  panel.V = V;
  panel.depth = depth;
  panel.edges = options_.graph == PicturedGraph::kAll;
  panel.handles = handle_positions(pictured.edit, V, false);
  panel.caption = caption;
  return panel;
}

void DrawingBook::add_deformed(const PicturedDrawing& pictured, const Eigen::Matrix2Xd& V,
                               const Eigen::VectorXd& depth, const std::string& caption) {
  add(pictured, deformed_panel(pictured, V, depth, caption));
}

void DrawingBook::add_to_sequence(std::int64_t frame, const PicturedDrawing& pictured,
                                  const Eigen::Matrix2Xd& V, const Eigen::VectorXd& depth,
                                  const std::string& caption) {
  sequence_[frame].push_back({pictured.bound, deformed_panel(pictured, V, depth, caption),
                              pictured.drawn_on, pictured.page});
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

// What each panel shows. Panels of drawings on the same page show the same, so that they can be
// compared. A drawing on another page is another one, and fills its own panels.
std::vector<Page> DrawingBook::frames(const std::vector<Entry>& panels) {
  std::vector<Page> frames;
  for (const Entry& entry : panels) {
    frames.push_back(entry.page ? *entry.page : frame_of(*entry.bound, {entry.panel}));
  }
  const std::vector<Page> own = frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (std::size_t j = 0; j < own.size(); ++j) {
      if (panels[i].drawn_on.isApprox(panels[j].drawn_on, 0)) frames[i].extend(own[j]);
    }
  }
  return frames;
}

std::vector<Image> DrawingBook::draw(const std::vector<Entry>& panels, int width) {
  const std::vector<Page> shown = frames(panels);
  std::vector<Image> images;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    images.push_back(draw_panel(*panels[i].bound, panels[i].panel, shown[i], width));
  }
  return images;
}

Image DrawingBook::render() const {
  const int width = options_.width == PictureOptions{}.width ? kPanelWidth : options_.width;
  const std::vector<Image> images = draw(panels_, width);
  const int columns = options_.columns > 0 ? options_.columns : 4;
  return grid(images, std::min(columns, static_cast<int>(images.size())));
}

// The panels of all pictures are drawn together, so that they have one size and framing.
std::vector<Image> DrawingBook::sequence(int width) const {
  std::vector<Entry> panels;
  std::size_t runs = 0;
  for (const auto& [frame, row] : sequence_) runs = std::max(runs, row.size());
  for (const auto& [frame, row] : sequence_) {
    if (row.size() == runs) panels.insert(panels.end(), row.begin(), row.end());
  }
  const std::vector<Image> images = draw(panels, width);
  std::vector<Image> pictures;
  for (auto row = images.begin(); row != images.end(); row += static_cast<std::ptrdiff_t>(runs)) {
    pictures.push_back(side_by_side({row, row + static_cast<std::ptrdiff_t>(runs)}));
  }
  return pictures;
}

std::unique_ptr<Book> make_drawing_book(const PictureOptions& options) {
  return std::make_unique<DrawingBook>(options);
}

}  // namespace deformlab
