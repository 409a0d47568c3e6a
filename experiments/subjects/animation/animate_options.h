#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deformers/embedded/embedded_deformation.h"
#include "experiments/subjects/animation/animate_command.h"
#include "experiments/subjects/animation/animation_pictures.h"
#include "experiments/subjects/picture_options.h"

namespace deformlab {

/// What key=value may set for `animate`.
struct AnimateOptions {
  EmbeddedDeformationOptions deformation;
  std::optional<int> path;
  PictureOptions picture;
  int pictured = 6;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    EmbeddedDeformationOptions::fields(o.deformation, visit);
    visit("path", o.path,
          "The id of the particle on whose path the nodes are sampled; by default, of those that "
          "live longest, the one that goes straightest");
    visit("picture", o.picture, "How the file of --picture is drawn");
    visit.range("pictured", o.pictured, {.min = 1, .max = kMostPictured},
                "The number of frames in --picture, evenly spread over the animation");
  }
};

/// Throws InputError for what is no option, or out of its range. The chain of a particle's path may
/// turn about itself at no cost to the paper's terms: for particles energies.smoothness is 1 where
/// nothing else is said, and linear_solver is kronecker_cg where no option of the solver is named.
AnimateOptions read_animate_options(const std::vector<std::string>& overrides,
                                    const AnimateFlags& flags);

}  // namespace deformlab
