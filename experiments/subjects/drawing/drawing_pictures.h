#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drawing/draw_panel.h"
#include "experiments/subjects/picture_options.h"
#include "experiments/subjects/shape/edit.h"

namespace deformlab {

/// A drawing that is pictured: itself, how stiff its triangles are, and what holds it.
struct PicturedDrawing {
  std::shared_ptr<const BoundDrawing> bound;
  Eigen::VectorXd weights;  ///< #F
  ResolvedEdit edit;
};

/// Collects the panels of a drawing's picture, as PictureBook does those of a shape's.
class DrawingBook {
 public:
  explicit DrawingBook(const PictureOptions& options) : options_(options) {}

  /// The drawing at rest with its mesh, painted triangles tinted, handles as dots.
  void add_rest(const PicturedDrawing& pictured);
  /// With its vertices at V (2×#V) and its triangles at depths (#F or 0).
  void add_deformed(const PicturedDrawing& pictured, const Eigen::Matrix2Xd& V,
                    const Eigen::VectorXd& depth, const std::string& caption);
  /// Step one's mesh, and the triangles fitted to it, 2×3#F corners (Igarashi et al. 2005, Figure
  /// 3).
  void add_stages(const PicturedDrawing& pictured, const Eigen::Matrix2Xd& intermediate,
                  const Eigen::Matrix2Xd& fitted);
  bool empty() const { return panels_.empty(); }
  Image render() const;

 private:
  struct Entry {
    std::shared_ptr<const BoundDrawing> bound;
    DrawingPanel panel;
  };

  PictureOptions options_;
  std::vector<Entry> panels_;
};

}  // namespace deformlab
