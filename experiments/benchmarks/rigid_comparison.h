#pragma once

#include <string>
#include <vector>

namespace deformlab {

/// How many times as fast as an iteration of CGAL's as-rigid-as-possible deformation an update of
/// the rigid 2D shape has to be, and a compilation as its preprocessing.
inline constexpr double kUpdateRatio = 15, kCompileRatio = 2;

/// The rigid 2D shape (Igarashi et al. 2005) beside CGAL's Surface_mesh_deformation on one mesh,
/// held at three vertices; medians [ms] and medians of ratios, measured in turns.
struct RigidComparison {
  int vertices = 0;
  double registration = 0;
  double compile = 0, cgal_preprocess = 0, compile_ratio = 0;
  double step_one = 0, fit = 0, step_two = 0, update = 0;
  double bare_solve = 0;  ///< of step two's triangular systems, without anything around it
  double cgal_iteration = 0, update_ratio = 0;

  bool holds() const { return update_ratio >= kUpdateRatio && compile_ratio >= kCompileRatio; }
};

/// On a five-armed shape, cut into about so many triangles' vertices.
RigidComparison compare_rigid(int vertices, int repetitions);

/// A Markdown table, and a line that gives the verdict.
std::string to_markdown(const std::vector<RigidComparison>& comparisons);

}  // namespace deformlab
