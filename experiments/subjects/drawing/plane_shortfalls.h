#pragma once

#include <string>
#include <vector>

#include "deformers/deformer.h"
#include "experiments/subjects/drawing/drawing_scene.h"
#include "experiments/subjects/shape/edit.h"

namespace deformlab {

/// Handles of a drawing that stop more than 2 % of the edit's motion, the longest way of a handle,
/// short of their targets, in one sentence for the user; nothing where all arrive. V (2×#V) are the
/// deformed vertices. The report tells what its method advises.
std::vector<std::string> missed_handles(const DrawingScene& scene, const Eigen::Matrix2Xd& V,
                                        const ResolvedEdit& edit, const Report& report);

/// Parts of a drawing that are turned inside out, as a reflection is, if they have two triangles
/// and more than 0.6 % of its area at rest, in one sentence for the user; nothing for smaller ones,
/// such as a fold at a handle, which can hardly be seen. V (2×#V) are the deformed vertices. The
/// report tells what its method advises.
std::vector<std::string> inside_out(const DrawingScene& scene, const Eigen::Matrix2Xd& V,
                                    const Report& report);

}  // namespace deformlab
