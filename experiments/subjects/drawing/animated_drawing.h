#pragma once

#include "experiments/subjects/subject.h"

namespace deformlab {

/// A drawing whose handles move from frame to frame (Igarashi et al. 2005, section 5.3). All frames
/// are posed before the first one is written: this tells the page that holds all of them, and what
/// cannot be done. Each frame begins with the one before, so that parts stay in front. A command
/// that was stopped goes on after the files that it made, and ends with the same bytes.
///
/// The metrics are those of SolveLog, and the greatest values over all frames of
/// PosedDrawing::metrics; frames; and depth_jumps (DepthJumps). Where a cursor blends poses:
/// poses_met, the number of poses to whose points the cursor comes in a frame, and pose_error, the
/// greatest distance there of a vertex from where the pose by itself has it [diagonal].
SubjectKind animated_drawing_kind();

}  // namespace deformlab
