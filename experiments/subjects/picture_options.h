#pragma once

#include <Eigen/Core>
#include <string>

namespace deformlab {

struct RenderOptions;

/// What a config's picture shows.
struct PictureOptions {
  Eigen::Vector3d direction{0.5, 1.0, -0.6};
  Eigen::Vector3d up{0, 0, 1};
  Eigen::Vector3d light{-0.8, 0.6, 0.5};
  int width = 800;
  int height = 600;
  int columns = 0;
  std::string graph = "rest";
  bool frames = false;
  bool rest = true;
  bool stages = false;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("direction", o.direction, "of view, from the eye into the scene");
    visit("up", o.up, "what points up in the picture");
    visit("light", o.light, "toward the main light: right, up, back to the camera");
    visit("width", o.width, "of one panel [pixel]; a drawing's are 420 wide where it is not set");
    visit("height", o.height, "of one panel [pixel]");
    visit("columns", o.columns, "panels beside each other; 0: two for one run, four for a sweep");
    visit.choice("graph", o.graph, {"rest", "all", "none"},
                 "panels with the deformation graph, or a drawing's mesh");
    visit("frames", o.frames,
          "draw a square at each node, along x and z at rest, that shows its R_j");
    visit("rest", o.rest, "a panel of the rest shape first");
    visit("stages", o.stages, "of a rigid shape: panels of step one and of the fitted triangles");
  }
};

/// Throws InputError for what no picture can show, so that it is found out before the work.
void check(const PictureOptions& options);

/// How a panel of such a picture is rendered.
RenderOptions render_options(const PictureOptions& options);

}  // namespace deformlab
