#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "geometry/graph/deformation_graph.h"
#include "geometry/shape/shape.h"
#include "render/camera.h"
#include "render/color.h"
#include "render/image.h"

namespace deformlab {

struct Ball {
  Eigen::Vector3d center;  ///< [length]
  double radius;           ///< [length]
  Color color;
};

struct Stick {
  Eigen::Vector3d a, b;  ///< ends [length]
  double radius;         ///< [length]
  Color color;
};

/// What one picture shows. Balls and sticks lie over the shape: where they are just below its
/// surface they are drawn as if on it, and deeper they fade out.
struct Panel {
  const Shape* shape =
      nullptr;  ///< may be left out; without a triangle of area it is drawn as dots
  Eigen::Matrix3Xd vertex_colors = {};  ///< 3×#V, or 3×0 for colors::kSurface everywhere
  std::vector<Ball> balls = {};
  std::vector<Stick> sticks = {};
  std::string caption = {};
  std::optional<Camera> camera = {};  ///< in the place of the options' one
};

struct RenderOptions {
  int width = 800;   ///< [pixel]
  int height = 600;  ///< [pixel], without the caption
  int samples = 3;   ///< rays a pixel, along each side
  int threads = 0;   ///< 0: as many as the machine has; the picture does not depend on it
  Camera camera = {};
  /// Toward the main light as the camera sees it: right, up, back to the camera. A low light from
  /// the side brings out relief.
  Eigen::Vector3d light{-0.80, 0.60, 0.50};
};

/// 3×#V: colors::kSurface, and `color` at the vertices named.
Eigen::Matrix3Xd tinted(const Shape& shape, const std::vector<int>& vertices,
                        const Color& color = colors::kFixed);

/// Radii that read well, as parts of the rest shape's bounding box diagonal.
inline constexpr double kNodeRadius = 0.004, kHandleRadius = 0.011;

/// Adds a ball for each column of `places` (3×n) [length].
void add_balls(Panel& panel, const Eigen::Matrix3Xd& places, double radius, const Color& color);

/// Adds a deformation graph with its nodes at `places` (3×m, deformed or at rest) [length]: balls
/// of the radius, and sticks a third as thick.
void add_graph(Panel& panel, const DeformationGraph& graph, const Eigen::Matrix3Xd& places,
               double radius);

/// The positions of all that the panels show, 3×n [length]: what `frame` needs to fit them all.
Eigen::Matrix3Xd extent(const std::vector<Panel>& panels);

/// The picture of one panel, on white, without its caption. The same input gives the same bytes.
/// Throws InputError where a position, radius or colour is not finite, or the colours are neither
/// none nor one a vertex.
Image render(const Panel& panel, const View& view, const RenderOptions& options);

/// A picture of each panel over its caption, all framed together and their margins cut alike.
/// Throws InputError as `render` does.
std::vector<Image> render_alike(const std::vector<Panel>& panels, const RenderOptions& options);

/// These in `columns` columns (0: one row); but where the panels have different cameras, or shapes
/// of very different sizes, each is framed by itself. Throws InputError as `grid` does too.
Image render_grid(const std::vector<Panel>& panels, const RenderOptions& options, int columns = 0);

}  // namespace deformlab
