#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "geometry/plane/barycentric_point.h"
#include "solvers/summary.h"

namespace deformlab {

/// The two steps of Igarashi et al. 2005, section 4: step one (similarity) finds an intermediate
/// shape v', each of its triangles is fitted by a congruent copy of the triangle at rest, and step
/// two (edge fit) finds the result v'' from these copies. ClosedFormSteps and GeneralSteps compute
/// the same two steps in two ways, which can be compared with each other.
class TwoStepSolver {
 public:
  /// The times of the parts of the last update [s].
  struct Seconds {
    double step_one = 0, fit = 0, step_two = 0;

    /// The times by name, with their sum as `total`.
    std::map<std::string, double> by_name() const {
      return {{"step_one", step_one},
              {"fit", fit},
              {"step_two", step_two},
              {"total", step_one + fit + step_two}};
    }
  };

  virtual ~TwoStepSolver() = default;

  /// Compilation: handles are at these points of the rest mesh. Points that share vertices and are
  /// not independent of each other meet their targets in the least-squares sense. The result does
  /// not depend on the handles before.
  virtual void compile(const std::vector<BarycentricPoint>& points) = 0;
  /// Update: moves the points to their targets, 2×#points [length].
  virtual void update(const Eigen::Matrix2Xd& targets) = 0;
  /// Returns to the rest shape; the handles stay. The next compilation adapts nothing.
  virtual void reset() = 0;

  /// The result v'' of the last update, 2×#V [length].
  virtual const Eigen::Matrix2Xd& positions() const = 0;
  /// The result v' of step one in the last update, 2×#V (Figure 3a) [length].
  virtual Eigen::Matrix2Xd intermediate() const = 0;
  /// The corners of the fitted triangles, 2×3·#F (Figure 3b) [length]. They are fitted to the
  /// intermediate shape or, where step two was repeated, to its last result but one.
  virtual Eigen::Matrix2Xd fitted() const = 0;

  /// What the last update did.
  virtual Summary summary() const = 0;
  const Seconds& seconds() const { return seconds_; }
  /// How many compilations did not only adapt the one before them.
  int compilations() const { return compilations_; }
  /// What a user should know about the compilation, one sentence each.
  const std::vector<std::string>& notes() const { return notes_; }

 protected:
  Seconds seconds_;
  int compilations_ = 0;
  std::vector<std::string> notes_;
};

}  // namespace deformlab
