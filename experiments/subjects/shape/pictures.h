#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deformers/embedded/adaptive_deformation.h"
#include "experiments/subjects/picture_options.h"
#include "experiments/subjects/shape/edit.h"
#include "render/image.h"
#include "render/render.h"

namespace deformlab {

/// Collects the panels of an experiment's picture: the rest shape, then what each run made of it,
/// with fixed vertices tinted and handles, their targets and the graph drawn in.
class PictureBook {
 public:
  explicit PictureBook(const PictureOptions& options) : options_(options) {}

  void look_by(const Camera& camera) { camera_ = camera; }  ///< at the panels to come
  void add_rest(const Deformer& deformer, const Shape& rest, const ResolvedEdit& edit);
  void add_deformed(const Deformer& deformer, const ResolvedEdit& edit, const std::string& caption);
  bool empty() const { return panels_.empty(); }
  Image render() const;

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
