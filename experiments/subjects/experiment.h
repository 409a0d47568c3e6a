#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "experiments/config/config_node.h"
#include "experiments/measure/depth_options.h"
#include "experiments/measure/drag.h"
#include "experiments/measure/probes.h"
#include "experiments/scenes/scene.h"
#include "experiments/subjects/animation/animation_options.h"
#include "experiments/subjects/claims.h"
#include "experiments/subjects/drawing/drawing_scene.h"
#include "experiments/subjects/methods.h"
#include "experiments/subjects/picture_options.h"

namespace deformlab {

/// One config file: one figure, table or ablation, with the numbers that it must show.
struct ExperimentConfig {
  std::string title;
  std::string paper;
  ShapeOptions shape;
  DrawingSceneOptions drawing;
  AnimationOptions animation;
  MethodOptions method;
  ConfigNode paint;
  ConfigNode cut;
  ConfigNode edit;
  DragOptions drag;
  DepthOptions depth;
  MeasureOptions measure;
  PictureOptions picture;
  ConfigNode sweep;
  std::vector<Claim> claims;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("title", o.title, "one line for the gallery");
    visit("paper", o.paper, "what the paper says of it");
    visit("shape", o.shape, "what is deformed");
    visit("drawing", o.drawing, "a drawing that is deformed in the plane instead");
    visit("animation", o.animation, "an animation that is edited instead");
    MethodOptions::fields(o.method, visit);
    visit("paint", o.paint,
          "stiff parts of a drawing: a list of {select, weight} or {mask: FILE.png, weight}");
    visit("cut", o.cut,
          "parts of a shape that follow no common node: a list of {between: SELECTION, and: "
          "SELECTION}");
    visit.required("edit", o.edit, "list of selections and what happens to them");
    visit("drag", o.drag, "in how many updates the handles reach their targets");
    visit("depth", o.depth, "which of two parts of a drawing that overlap is in front");
    visit("measure", o.measure, "what is measured beyond what every run measures");
    visit("picture", o.picture, "how it is drawn");
    visit("sweep", o.sweep,
          "dotted keys and lists of values, or a word and maps of keys by name: every combination "
          "is run");
    visit("claims", o.claims, "what the measurements must show");
  }
};

}  // namespace deformlab
