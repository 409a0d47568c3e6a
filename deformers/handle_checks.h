#pragma once

#include <Eigen/Core>

#include "deformers/deformer.h"

/// What every deformer checks and measures about its handles.
namespace deformlab {

/// Throws InputError for a vertex that does not exist, is both fixed and moved or is moved twice,
/// for a point that is not finite, for rotations, groups or weights that are not one for each
/// target or none, and for a weight that is not a finite number above 0. `vertices` is the number
/// of the shape's vertices.
void check_handles(const Handles& handles, Eigen::Index vertices);

/// Throws InputError where handles have weights. It is for methods that hold handles exactly.
void refuse_weights(const Handles& handles);

/// Throws InputError where there are not `count` targets (3×#targets) or one is not finite.
void check_targets(const Eigen::Matrix3Xd& targets, Eigen::Index count);

/// Sets handle_rms and handle_max of a report, which stay 0 where there is no handle.
///   reached, targets  3×#handles, positions of the handles and of their targets [length]
void measure_handles(const Eigen::Matrix3Xd& reached, const Eigen::Matrix3Xd& targets,
                     Report& report);

}  // namespace deformlab
