#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "deformers/deformer.h"
#include "geometry/graph/graph_cut.h"
#include "geometry/shape/handles.h"
#include "geometry/shape/shape.h"

// Whether a deformation did what its edit asked for, in the words of a user. Each function returns
// one sentence for each kind of shortfall, and nothing where all is well.
namespace deformlab {

/// The longest way of a handle from its position at rest to its target, straight or along the arc
/// on which it turns with its group [length].
double edit_motion(const Shape& rest, const Handles& handles, const Eigen::Matrix3Xd& targets);

/// How far a handle may stop short of its target: 2 % of the edit's motion, or more where rounding
/// errors of a shape of this size are [length].
double allowed_miss(double motion, double size);

/// Handles that stop more than 2 % of the edit's motion, the longest way of a handle, short of
/// their targets, and whatever the report calls undone.
///   V        3×#V, the deformed vertices [length]
///   targets  3×#handles, as in Deformer::update [length]
std::vector<std::string> missed_handles(const Shape& rest, const Eigen::Matrix3Xd& V,
                                        const Handles& handles, const Eigen::Matrix3Xd& targets,
                                        const Report& report);

/// Edges that become more than 5 times as long as those around them let expect, and seams that
/// open: vertices at one position at rest that end more than half a mean edge apart, unless a cut
/// is between them.
std::vector<std::string> tears(const Shape& rest, const Eigen::Matrix3Xd& V, const Report& report,
                               std::span<const Cut> cuts = {});

/// Nodes that are inside out.
std::vector<std::string> inside_out(const Report& report);

/// Throws InputError where the edit asks for a motion and none of its handles can move.
void check_movable(const Shape& rest, const Handles& handles, const Eigen::Matrix3Xd& targets,
                   const Report& report);

}  // namespace deformlab
