#pragma once

#include "experiments/subjects/animation/animation_options.h"
#include "experiments/subjects/motion/script.h"

namespace deformlab {

/// The script of an animated drawing. It has either keyframes, or poses and a cursor, or handles
/// and their performance. A performance becomes keyframes.
struct PlaneScript {
  Script script;
  std::optional<SpatialScript> spatial;  ///< of poses and a cursor
  FrameRange range;                      ///< from the first moment that is recorded to the last one
};

/// Keyframes stand in the order of time, and there are two or more; so are poses, no two at one
/// point. Throws InputError as read_script, read_cursor and read_performance do, for keyframes in
/// another order, for an option of meshes, and for a frame below 0, too many frames, or none.
PlaneScript read_plane_script(const ConfigNode& edit, const AnimationOptions& options);

/// All entries of a script.
std::vector<EditEntry> all_entries(const Script& script);

}  // namespace deformlab
