#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "geometry/core/options.h"

namespace deformlab {

struct Camera;
struct RenderOptions;

/// The panels in which the deformation graph, or a drawing's mesh, is shown.
enum class PicturedGraph { kRest, kAll, kNone };
constexpr auto names_of(PicturedGraph) {
  using enum PicturedGraph;
  return std::to_array<EnumName<PicturedGraph>>({{kRest, "rest"}, {kAll, "all"}, {kNone, "none"}});
}

/// What a config's picture shows.
struct PictureOptions {
  std::optional<Eigen::Vector3d> direction, up;
  Eigen::Vector3d light{-0.8, 0.6, 0.5};
  int width = 800;
  int height = 600;
  int columns = 0;
  PicturedGraph graph = PicturedGraph::kRest;
  bool frames = false;
  bool rest = true;
  bool steps = false;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("direction", o.direction,
          "The direction of view, from the eye into the scene; without one, the camera looks "
          "obliquely from above");
    visit("up", o.up,
          "The direction that points up in the picture; without one, it is z if `direction` is "
          "given, and otherwise y or z, on whichever the shape stands");
    visit("light", o.light,
          "The direction toward the main light: to the right, up, and back to the camera");
    visit.range("width", o.width, {.min = 1, .max = 4096},
                "The width of one panel; those of a drawing are 420 wide where it is not set "
                "[pixel]");
    visit.range("height", o.height, {.min = 1, .max = 4096}, "The height of one panel [pixel]");
    visit.range("columns", o.columns, {.min = 0},
                "The number of panels beside each other; 0 gives two for one run, and four for a "
                "sweep");
    visit("graph", o.graph, "The panels that show the deformation graph, or the mesh of a drawing");
    visit("frames", o.frames,
          "Whether a square at each node, which lies along x and z at rest, shows its R_j");
    visit("rest", o.rest, "Whether the first panel shows the rest shape");
    visit("steps", o.steps,
          "Whether arap_2d has panels of step one's result and of the fitted triangles");
  }
};

/// Throws InputError for an impossible direction of view.
void check(const PictureOptions& options);

/// The direction in which a shape is seen that has the vertices V (3×#V) at rest.
Camera camera_for(const PictureOptions& options, const Eigen::Matrix3Xd& V);

/// How a panel of such a picture is rendered, apart from its camera.
RenderOptions render_options(const PictureOptions& options);

}  // namespace deformlab
