#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "deformers/arap_2d/handle_points.h"
#include "solvers/summary.h"

namespace deformlab {

/// The two steps of Igarashi et al. 2005 (section 4), whoever takes them. Positions are 2×#V.
class TwoStepSolver {
 public:
  /// Of the last update [s].
  struct Seconds {
    double step_one = 0, fit = 0, step_two = 0;
  };

  virtual ~TwoStepSolver() = default;
  /// Places that share vertices without being independent are met in the least-squares sense.
  virtual void compile(const std::vector<BarycentricPoint>& places) = 0;
  /// Takes the places to their targets, 2×k [length].
  virtual void update(const Eigen::Matrix2Xd& targets) = 0;
  virtual void reset() = 0;  ///< back to rest

  virtual const Eigen::Matrix2Xd& positions() const = 0;  ///< v'', the result
  /// v' of the last update, the result of step one (Figure 3a).
  virtual Eigen::Matrix2Xd intermediate() const = 0;
  /// 2×3·#F corners of the triangles fitted to it or, where step two was refined, to the last
  /// result but one (Figure 3b).
  virtual Eigen::Matrix2Xd fitted() const = 0;

  virtual Summary summary() const = 0;  ///< of the last update
  const Seconds& seconds() const { return seconds_; }
  const std::vector<std::string>& notes() const { return notes_; }  ///< of the compilation

 protected:
  Seconds seconds_;
  std::vector<std::string> notes_;
};

}  // namespace deformlab
