#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "deformers/embedded_deformation.h"
#include "experiments/claims.h"
#include "experiments/config_node.h"
#include "experiments/drag.h"
#include "experiments/probes.h"
#include "experiments/scene.h"

namespace deformlab {

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

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("direction", o.direction, "of view, from the eye into the scene");
    visit("up", o.up, "what points up in the picture");
    visit("light", o.light, "toward the main light: right, up, back to the camera");
    visit("width", o.width, "of one panel [pixel]");
    visit("height", o.height, "of one panel [pixel]");
    visit("columns", o.columns, "panels beside each other; 0: two for one run, four for a sweep");
    visit.choice("graph", o.graph, {"rest", "all", "none"}, "panels with the deformation graph");
    visit("frames", o.frames,
          "draw a square at each node, along x and z at rest, that shows its R_j");
    visit("rest", o.rest, "a panel of the rest shape first");
  }
};

/// One config file: one figure, table or ablation, with the numbers that it must show.
struct ExperimentConfig {
  std::string title;
  std::string paper;
  ShapeOptions shape;
  EmbeddedDeformationOptions deformation;
  ConfigNode edit;
  DragOptions drag;
  MeasureOptions measure;
  PictureOptions picture;
  ConfigNode sweep;
  std::vector<Claim> claims;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("title", o.title, "one line for the gallery");
    visit("paper", o.paper, "what the paper says of it");
    visit("shape", o.shape, "what is deformed");
    EmbeddedDeformationOptions::fields(o.deformation, visit);
    visit.required("edit", o.edit, "list of selections and what happens to them");
    visit("drag", o.drag, "in how many updates the handles reach their targets");
    visit("measure", o.measure, "what is measured beyond what every run measures");
    visit("picture", o.picture, "how it is drawn");
    visit("sweep", o.sweep, "dotted keys and lists of values: every combination is run");
    visit("claims", o.claims, "what the measurements must show");
  }
};

}  // namespace deformlab
