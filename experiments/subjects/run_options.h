#pragma once

#include "experiments/config/config_node.h"
#include "experiments/measure/depth_options.h"
#include "experiments/measure/drag.h"
#include "experiments/measure/probes.h"
#include "experiments/scenes/scene.h"
#include "experiments/subjects/animation/animation_options.h"
#include "experiments/subjects/drawing/drawing_scene.h"
#include "experiments/subjects/drawing/output_page.h"
#include "experiments/subjects/methods.h"
#include "experiments/subjects/picture_options.h"

namespace deformlab {

/// All options of one run. A config sets them for each run of its sweep; the commands `deform` and
/// `animate` set them for the one run that they do.
struct RunOptions {
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
  DrawingOutputOptions output;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("shape", o.shape, "The shape that is deformed");
    visit("drawing", o.drawing, "A drawing that is deformed in the plane instead of a shape");
    visit("animation", o.animation, "An animation that is edited instead of a shape");
    MethodOptions::fields(o.method, visit);
    visit("paint", o.paint,
          "Stiff parts of a shape or a drawing: a list of {select, weight}, or of {mask: FILE.png, "
          "weight} for a drawing");
    visit("cut", o.cut,
          "Parts of a shape that follow no common node: a list of {between: SELECTION, and: "
          "SELECTION}; of a drawing, lines along which it is cut: a list of lists of points [x, y] "
          "[pixel]");
    visit.required("edit", o.edit, "A list of selections and what happens to them");
    visit("drag", o.drag, "The updates in which the handles go to their targets");
    visit("depth", o.depth, "Which of two parts of a drawing is in front where they overlap");
    visit("measure", o.measure, "What is measured beyond what every run measures");
    visit("picture", o.picture, "How the picture is drawn");
    visit("output", o.output, "How a deformed drawing is written and pictured");
  }
};

/// Reads the options and completes the weights of the energies. Throws InputError as read_config
/// does, and for the name of an energy that does not exist.
RunOptions read_run_options(const ConfigNode& root);

/// Sets the options of embedded deformation to the preset that `root` names, before its other keys
/// are read. Throws InputError for another name.
void begin_with_preset(const ConfigNode& root, MethodOptions& options);

/// Completes the options that were read from `root`: adds the default weights of the energies that
/// `root` does not name. Throws InputError for a key below `energies` or `losses` that is not the
/// name of an energy.
void complete_energies(const ConfigNode& root, EmbeddedDeformationOptions& options);

/// Throws InputError for options that no kind of subject supports.
void check_run_options(const RunOptions& options, const ConfigNode& root);

}  // namespace deformlab
