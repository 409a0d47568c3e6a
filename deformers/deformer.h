#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "geometry/shape/handles.h"
#include "geometry/shape/shape.h"
#include "solvers/summary.h"

namespace deformlab {

/// What a user can do where a method does not hold an edit. A method whose options help names them.
struct Advice {
  std::string missed = "fix less around it";  ///< a handle stops short of its target
  std::string torn = "move the handles less, or let more of the shape move";
  std::string open_seam = "move both sides together";
  std::string inside_out = "move the handles less, or say how they turn with 'rotate'";
  std::string immovable = "fix fewer vertices";  ///< no handle can move
};

/// The report of an update.
struct Report {
  Summary solve;
  int nodes = 0, edges = 0;
  /// The least det R over all nodes, or triangles of a drawing: 1 for rotations, below 0 where
  /// space is flipped.
  double min_det_R = 1;
  int inside_out = 0;      ///< how many of them have det R < 0
  double handle_rms = 0;   ///< root mean square distance of the handles to their targets [length]
  double handle_max = 0;   ///< the largest such distance [length]
  int immovable = 0;       ///< handles that follow fixed nodes only and so cannot move
  double length_unit = 1;  ///< one unit of the solver [length]
  /// The time of each phase by its name [s].
  std::map<std::string, double> seconds;
  /// What a user should know, one sentence each: parts without a handle, handles that cannot move,
  /// rules that were applied.
  std::vector<std::string> notes;
  /// What the edit asked for and the shape does not hold, one sentence each.
  std::vector<std::string> undone;
  Advice advice;
};

/// A method that deforms a rest shape by handles. It works in three phases, each of which costs
/// less than the one before: registration of the rest shape (the constructor), compilation of a set
/// of handles, and update of the handles' targets.
class Deformer {
 public:
  virtual ~Deformer() = default;
  /// Compilation: handles are added or removed. An editor gives the whole new set; a method that
  /// can keeps what the set before it has in common with it, and the result is the same. Throws
  /// InputError for a vertex that does not exist, is both fixed and moved or is moved twice, for a
  /// point that is not finite, and for rotations, groups or weights that are not one for each
  /// target or none, and for weights that the method does not take. The deformer is then as it was
  /// before.
  virtual void compile(const Handles& handles) = 0;
  /// Update: the moved handles go to their targets, first those of `moved`, then those of `points`
  /// (3×#targets) [length]. It starts from the result of the last update. Throws InputError for
  /// another number of targets, or for one that is not finite. Where the deformation fails
  /// numerically, the report says so and the shape stays as the last update left it.
  virtual Report update(const Eigen::Matrix3Xd& targets) = 0;
  /// The result of the last update.
  virtual const Shape& deformed() const = 0;
  /// Returns to the rest shape. The handles stay.
  virtual void reset() = 0;
};

}  // namespace deformlab
