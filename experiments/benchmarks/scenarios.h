#pragma once

#include <vector>

#include "experiments/benchmarks/ab_runner.h"

namespace deformlab {

/// Whole edits of the reference scene: from rest, a drag, and a hard scene, each against Ceres, our
/// CHOLMOD path or CGAL.
std::vector<Scenario> edit_scenarios();

/// One Gauss–Newton step with CHOLMOD against a step of every sensible configuration of Ceres. The
/// time of the whole solve is a further figure.
std::vector<Scenario> step_scenarios();

/// Igarashi's two-step deformation of a drawing against CGAL's as-rigid-as-possible deformation.
std::vector<Scenario> drawing_scenarios();

/// All of them.
std::vector<Scenario> scenarios();

}  // namespace deformlab
