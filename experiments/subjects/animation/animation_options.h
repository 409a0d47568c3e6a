#pragma once

#include <optional>
#include <string>

#include "experiments/subjects/animation/animation_pictures.h"
#include "experiments/subjects/animation/script.h"

namespace deformlab {

/// The animation of a config, in the place of a shape.
struct AnimationOptions {
  std::string generator = "none";
  int frames = 24;
  double cycle = 24;    ///< frames of one cycle of a gait
  double bend = 0;      ///< of the jet [degree]
  double cell = 0.031;  ///< mean distance of the quadruped's vertices [length]
  KeyframesOptions keyframes;
  std::optional<int> path;
  int pictured = 6;
  SequenceOptions sequence;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.choice("generator", o.generator, {"none", "gallop", "jet"},
                 "a quadruped that gallops, or a jet of particles");
    visit("frames", o.frames, "how many");
    visit("cycle", o.cycle, "frames of one cycle of the gait");
    visit("cell", o.cell, "mean distance of the quadruped's vertices; its length is about 2.7");
    visit("bend", o.bend, "how far the jet turns upwards over its length [degree], 0 to 180");
    KeyframesOptions::fields(o.keyframes, visit);
    visit("path", o.path, "id of the particle whose path carries the graph; else it is chosen");
    visit("pictured", o.pictured, "frames in the picture, evenly spread");
    visit("sequence", o.sequence, "its frames one by one, as pictures in a folder beside it");
  }
};

/// Throws InputError for options out of range, and for what read_script does.
void check(const AnimationOptions& options, const ConfigNode& edit);

}  // namespace deformlab
