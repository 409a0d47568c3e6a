#pragma once

#include "experiments/subjects/animation/animation_options.h"
#include "experiments/subjects/motion/script.h"

namespace deformlab {

/// The script of an animated drawing. Its keyframes stand in the order of time, and there are two
/// or more. Throws InputError as read_script does, for keyframes in another order, and for an
/// option of meshes.
Script read_plane_script(const ConfigNode& edit, const AnimationOptions& options);

/// All entries of a script.
std::vector<EditEntry> all_entries(const Script& script);

/// The frames of an animated drawing: from the first keyframe to the last one. Throws InputError
/// for a frame below 0, for too many frames, and if there is none.
FrameRange frames_of(const Script& script);

}  // namespace deformlab
