#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "deformers/deformer.h"

/// What the methods to compare with have in common.
namespace deformlab::baselines {

/// Throws InputError for a vertex that does not exist or is both fixed and moved.
void check_handles(const Handles& handles, Eigen::Index vertices);

/// Throws InputError where a handle is no vertex, which `method` cannot take.
void refuse_points(const Handles& handles, const std::string& method);

/// The triangles of a shape (3×#T), each of three different vertices; others are left out.
/// Throws InputError where there are none, which `method` cannot do without.
Eigen::Matrix3Xi proper_triangles(const Shape& shape, const std::string& method);

/// Throws InputError for another number of targets than `count`, or one that is not finite.
void check_targets(const Eigen::Matrix3Xd& targets, Eigen::Index count);

/// handle_rms and handle_max of a report.
///   reached, targets  3×p [length]
void measure_handles(const Eigen::Matrix3Xd& reached, const Eigen::Matrix3Xd& targets,
                     Report& report);

/// The connected component of each of n things, numbered in the order of their first members.
std::vector<int> components(int n, const std::vector<std::pair<int, int>>& links);

}  // namespace deformlab::baselines
