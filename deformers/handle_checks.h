#pragma once

#include <Eigen/Core>

#include "deformers/deformer.h"

/// What every deformer checks and measures of its handles.
namespace deformlab {

/// Throws InputError for a vertex that does not exist, is both fixed and moved or is moved twice,
/// and for a place that is not finite. `vertices` is how many the shape has.
void check_handles(const Handles& handles, Eigen::Index vertices);

/// Throws InputError for another number of targets (3×#) than `count`, or one that is not finite.
void check_targets(const Eigen::Matrix3Xd& targets, Eigen::Index count);

/// handle_rms and handle_max of a report; both stay 0 where there is no handle.
///   reached, targets  3×#handles [length]
void measure_handles(const Eigen::Matrix3Xd& reached, const Eigen::Matrix3Xd& targets,
                     Report& report);

}  // namespace deformlab
