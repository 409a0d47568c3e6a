#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "deformers/arap_2d/arap_2d.h"
#include "drawing/write_drawing.h"
#include "experiments/measure/depth_options.h"
#include "experiments/subjects/drawing/drawing_pictures.h"
#include "experiments/subjects/drawing/drawing_scene.h"

namespace deformlab {

/// A drawing that a run deforms, in one picture or in many: what was read, the method that deforms
/// it, and which of its parts are in front.
class PosedDrawing {
 public:
  /// Reads the drawing. `entries` of the edit say which detached parts have handles. Throws
  /// InputError if it cannot be read, triangulated, painted or deformed.
  PosedDrawing(const RunOptions& options, const RunContext& context,
               const std::vector<EditEntry>& entries);

  const DrawingScene& scene() const { return scene_; }
  const Shape& rest() const { return rest_; }
  /// What entries select and do at rest. Throws InputError as resolve does.
  ResolvedEdit resolve(const std::vector<EditEntry>& entries) const;

  Deformer& deformer() const { return *deformer_; }
  const Arap2d* arap() const { return arap_; }  ///< the deformer, if it is of this class

  /// Has to be called after each update of the deformer: takes over its vertices and finds out
  /// which parts are in front.
  void show();
  /// Returns to rest, also the deformer, and forgets which parts were in front. The handles stay.
  void reset();

  const Eigen::Matrix2Xd& V() const { return V_; }           ///< deformed, 2×#V [length]
  const Eigen::VectorXd& depths() const { return depths_; }  ///< #F
  const Overlaps& overlaps() const { return depth_->overlaps(); }

  /// The drawing bound to its mesh. This is done when it is first needed, because it takes time.
  std::shared_ptr<const BoundDrawing> bound();
  PicturedDrawing pictured(const ResolvedEdit& edit);
  /// The measurements of the shape that is shown: those of its mesh, plane_distortion,
  /// DrawingDepth and painted_distortion.
  Metrics metrics() const;

 private:
  DrawingScene scene_;
  OutputPage page_;
  Shape rest_;
  std::unique_ptr<Deformer> deformer_;
  const Arap2d* arap_ = nullptr;
  std::optional<DrawingDepth> depth_;
  Eigen::Matrix2Xd V_;
  Eigen::VectorXd depths_;
  std::shared_ptr<const BoundDrawing> bound_;
};

/// Throws InputError for options of a drawing, apart from its edit, that cannot be used.
void check_drawing_options(const RunOptions& options);

/// Puts the defaults of commands into the config of a drawing.
void set_drawing_defaults(const CommandLine& line, ConfigNode& root);

}  // namespace deformlab
