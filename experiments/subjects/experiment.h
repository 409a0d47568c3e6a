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
    visit("title", o.title, "One line for the gallery");
    visit("paper", o.paper, "What the paper says about it");
    visit("shape", o.shape, "The shape that is deformed");
    visit("drawing", o.drawing, "A drawing that is deformed in the plane instead of a shape");
    visit("animation", o.animation, "An animation that is edited instead of a shape");
    MethodOptions::fields(o.method, visit);
    visit("paint", o.paint,
          "Stiff parts of a drawing: a list of {select, weight} or {mask: FILE.png, weight}");
    visit("cut", o.cut,
          "Parts of a shape that follow no common node: a list of {between: SELECTION, and: "
          "SELECTION}");
    visit.required("edit", o.edit, "A list of selections and what happens to them");
    visit("drag", o.drag, "The updates in which the handles go to their targets");
    visit("depth", o.depth, "Which of two parts of a drawing is in front where they overlap");
    visit("measure", o.measure, "What is measured beyond what every run measures");
    visit("picture", o.picture, "How the picture is drawn");
    visit(
        "sweep", o.sweep,
        "Dotted keys with lists of values, or a word with maps of keys by name; every combination "
        "is run");
    visit("claims", o.claims, "What the measurements must show");
  }
};

}  // namespace deformlab
