#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deformers/embedded/adaptive_deformation.h"
#include "experiments/subjects/picture_options.h"
#include "experiments/subjects/shape/edit.h"
#include "experiments/subjects/subject.h"
#include "render/image.h"
#include "render/render.h"

namespace deformlab {

/// Collects the panels of shapes: the rest shape, and then the deformed shape of each run. Fixed
/// vertices are tinted. Handles, their targets and the graph are drawn.
class PictureBook : public Book {
 public:
  explicit PictureBook(const PictureOptions& options) : options_(options) {}

  void look_by(const Camera& camera) {
    camera_ = camera;
  }  ///< for all panels that are added from now on
  void add_rest(const Deformer& deformer, const Shape& rest, const ResolvedEdit& edit);
  void add_deformed(const Deformer& deformer, const ResolvedEdit& edit, const std::string& caption);
  bool empty() const override { return panels_.empty(); }
  Image render() const override;

 private:
  void add(const Shape& shape, const ResolvedEdit& edit, const Eigen::Matrix3Xd& points,
           const std::string& caption);
  void add_graph(const EmbeddedDeformation& deformer, const Transformations& X);

  PictureOptions options_;
  std::optional<Camera> camera_;
  std::vector<std::unique_ptr<Shape>> shapes_;  // the panels point at them
  std::vector<Panel> panels_;
};

}  // namespace deformlab
