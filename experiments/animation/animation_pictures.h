#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deformers/embedded_deformation.h"
#include "experiments/picture_options.h"
#include "experiments/render.h"

namespace deformlab {

/// A contact sheet: some frames of the input in one row, and below it the same frames of each run.
class AnimationBook {
 public:
  explicit AnimationBook(const PictureOptions& options) : options_(options) {}

  /// Frames in a row are added from left to right, and row by row; `handles` is 3×n [length].
  void add(const Shape& frame, const Eigen::Matrix3Xd& handles, const std::string& caption);
  /// Draws the graph into the last panel, where the options ask for it.
  void add_graph(const DeformationGraph& graph, bool input);
  void set_columns(int columns) { columns_ = columns; }
  bool empty() const { return panels_.empty(); }
  Image render() const;

 private:
  PictureOptions options_;
  int columns_ = 1;
  std::vector<std::unique_ptr<Shape>> shapes_;  // the panels point at them
  std::vector<Panel> panels_;
};

}  // namespace deformlab
