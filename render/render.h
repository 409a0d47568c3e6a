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

/// What one picture shows. Balls and sticks that are just below the surface of the shape are drawn
/// as if they were on it. Deeper ones fade out.
struct Panel {
  const Shape* shape =
      nullptr;  ///< may be null; if no triangle has an area, vertices are drawn as dots
  Eigen::Matrix3Xd vertex_colors = {};  ///< 3×#V, or 3×0 for colors::kSurface everywhere
  std::vector<Ball> balls = {};
  std::vector<Stick> sticks = {};
  std::string caption = {};
  std::optional<Camera> camera = {};  ///< replaces the camera of the options
};

struct RenderOptions {
  int width = 800;   ///< [pixel]
  int height = 600;  ///< [pixel], without the caption
  int samples = 3;   ///< rays along each side of a pixel at edges; one ray meets the others
  int threads = 0;   ///< 0: as many as the machine has; the picture does not depend on them
  Camera camera = {};
  /// The direction to the main light in the axes of the camera: to the right, up, and back to the
  /// camera. A low light from the side shows relief well.
  Eigen::Vector3d light{-0.80, 0.60, 0.50};
};

/// The vertex colours of a shape, 3×#V: `color` at the given vertices, else colors::kSurface.
/// Throws InputError for a vertex that does not exist.
Eigen::Matrix3Xd tinted(const Shape& shape, const std::vector<int>& vertices,
                        const Color& color = colors::kFixed);

/// Suitable radii of balls, as parts of the diagonal of the rest shape's bounding box.
inline constexpr double kNodeRadius = 0.004, kHandleRadius = 0.011;

/// Adds a ball for each column of `places` (3×n) [length].
void add_balls(Panel& panel, const Eigen::Matrix3Xd& places, double radius, const Color& color);

/// Adds a deformation graph whose nodes are at `places` (3×m) [length], deformed or at rest: balls
/// of this radius, and sticks that are a third as thick.
void add_graph(Panel& panel, const DeformationGraph& graph, const Eigen::Matrix3Xd& places,
               double radius);

/// The positions of all that the panels show, 3×n [length], as `frame` needs them.
Eigen::Matrix3Xd extent(const std::vector<Panel>& panels);

/// The picture of one panel, on white, without its caption. The same input gives the same bytes.
/// Throws InputError if a position, radius or colour is not finite, if there is neither no colour
/// nor one for each vertex, or if an option is out of range.
Image render(const Panel& panel, const View& view, const RenderOptions& options);

/// A picture of each panel over its caption. All are framed together, and their margins cropped
/// alike. Throws InputError as `render` does.
std::vector<Image> render_alike(const std::vector<Panel>& panels, const RenderOptions& options);

/// The pictures of render_alike in `columns` columns, or in one row for 0. If the panels have
/// different cameras, or shapes of very different sizes, each is framed by itself. Throws
/// InputError as `render` and `grid` do.
Image render_grid(const std::vector<Panel>& panels, const RenderOptions& options, int columns = 0);

}  // namespace deformlab
