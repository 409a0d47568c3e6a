#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "geometry/shape/handles.h"
#include "geometry/shape/shape.h"
#include "solvers/summary.h"

namespace deformlab {

/// What an update did.
struct Report {
  Summary solve;
  int nodes = 0, edges = 0;
  double min_det_R = 1;    ///< over all nodes, or triangles of a drawing: 1 for rotations, below 0
                           ///< where space is flipped
  int inside_out = 0;      ///< of these, with det R < 0
  double handle_rms = 0;   ///< root mean square distance of the handles to their targets [length]
  double handle_max = 0;   ///< the largest such distance [length]
  double length_unit = 1;  ///< one unit of the solver [length]
  std::map<std::string, double> seconds;  ///< by phase: registration, compilation, solve, transfer
  std::vector<std::string> notes;         ///< what a user should know: free parts, handles that
                                          ///< cannot move, rules that were applied
};

/// A way to deform a rest shape by handles, in three phases that cost less each: registration of
/// the shape (the constructor), compilation of a set of handles, update for where they go.
class Deformer {
 public:
  virtual ~Deformer() = default;
  /// Handles are added or removed. Throws InputError for a vertex that does not exist, is both
  /// fixed and moved or is moved twice, and for a place that is not finite.
  virtual void compile(const Handles& handles) = 0;
  /// Handles move: 3×#moved targets [length]. Starts from where the last update ended.
  /// Throws InputError for another number of targets, or one that is not finite.
  virtual Report update(const Eigen::Matrix3Xd& targets) = 0;
  /// The shape as the last update left it.
  virtual const Shape& deformed() const = 0;
  /// Back to the rest shape; the handles stay.
  virtual void reset() = 0;
};

}  // namespace deformlab
