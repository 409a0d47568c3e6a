#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drawing/draw_panel.h"
#include "experiments/subjects/picture_options.h"
#include "experiments/subjects/shape/edit.h"
#include "experiments/subjects/subject.h"

namespace deformlab {

/// A drawing that is pictured, its own page, the weights of its triangles, its handles, and what
/// its panels show if that does not depend on the deformation.
struct PicturedDrawing {
  std::shared_ptr<const BoundDrawing> bound;
  Page drawn_on;
  Eigen::VectorXd weights;  ///< #F
  ResolvedEdit edit;
  std::optional<Page> page = {};
};

/// Collects the panels of drawings, as PictureBook does for shapes.
class DrawingBook : public Book {
 public:
  explicit DrawingBook(const PictureOptions& options) : options_(options) {}

  /// Shows the drawing at rest with its mesh. Painted triangles are tinted, and handles are dots.
  void add_rest(const PicturedDrawing& pictured);
  /// Shows the drawing with the vertices at V (2×#V). `depth` has #F entries, or none.
  void add_deformed(const PicturedDrawing& pictured, const Eigen::Matrix2Xd& V,
                    const Eigen::VectorXd& depth, const std::string& caption);
  /// Shows the mesh of step one, 2×#V, and the corners of the triangles that are fitted to it,
  /// 2×3#F (Igarashi et al. 2005, Figure 3).
  void add_steps(const PicturedDrawing& pictured, const Eigen::Matrix2Xd& intermediate,
                 const Eigen::Matrix2Xd& fitted);
  /// Shows a frame of an animation in the picture of the sequence that has this number. Each run
  /// that is added has a panel in it.
  void add_to_sequence(std::int64_t frame, const PicturedDrawing& pictured,
                       const Eigen::Matrix2Xd& V, const Eigen::VectorXd& depth,
                       const std::string& caption);
  bool empty() const override { return panels_.empty(); }
  Image render() const override;
  std::vector<Image> sequence(int width) const override;

 private:
  struct Entry {
    std::shared_ptr<const BoundDrawing> bound;
    DrawingPanel panel;
    Page drawn_on;
    std::optional<Page> page;
  };
  static std::vector<Page> frames(const std::vector<Entry>& panels);
  static std::vector<Image> draw(const std::vector<Entry>& panels, int width);
  DrawingPanel deformed_panel(const PicturedDrawing& pictured, const Eigen::Matrix2Xd& V,
                              const Eigen::VectorXd& depth, const std::string& caption) const;
  void add(const PicturedDrawing& pictured, DrawingPanel panel);

  PictureOptions options_;
  std::vector<Entry> panels_;
  std::map<std::int64_t, std::vector<Entry>> sequence_;
};

/// The book of all kinds of subjects that are drawings.
std::unique_ptr<Book> make_drawing_book(const PictureOptions& options);

}  // namespace deformlab
