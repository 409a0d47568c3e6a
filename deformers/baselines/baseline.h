#pragma once

#include <map>
#include <string>
#include <vector>

#include "deformers/deformer.h"

namespace deformlab {

/// The base class of the methods of comparison. It checks and times a compilation, checks an
/// update, and completes its report. A method implements the protected functions.
class Baseline : public Deformer {
 public:
  void compile(const Handles& handles) final;
  Report update(const Eigen::Matrix3Xd& targets) final;
  const Shape& deformed() const final { return deformed_; }

 protected:
  explicit Baseline(Shape rest);

  /// Throws InputError for handles that the method cannot use. `compile` has already made the
  /// checks that Deformer requires.
  virtual void check_supported(const Handles& handles) const;
  /// Compiles handles_, and writes compilation_notes_.
  virtual void compile_handles() = 0;
  /// Sets deformed_ so that the handles meet their targets (3×#targets) [length]. Fills the report
  /// except for its notes and for the seconds of registration, compilation and solve. The seconds
  /// of solve are then copied from the summary's `total`.
  virtual void solve(const Eigen::Matrix3Xd& targets, Report& report) = 0;

  Shape rest_, deformed_;
  Handles handles_;
  std::map<std::string, double> seconds_;  // of registration and compilation
  std::vector<std::string> registration_notes_, compilation_notes_;
};

}  // namespace deformlab
