#pragma once

#include <exception>
#include <mutex>

#include "energies/energy.h"

namespace deformlab {

/// What goes wrong while Ceres evaluates. Ceres cannot pass on an exception, which would end the
/// process in one of its threads, and it does not say which residual was not finite.
class Trouble {
 public:
  /// Keeps the exception that is being handled, unless there is an earlier one.
  void keep_exception() {
    const std::lock_guard lock(mutex_);
    if (!thrown_) thrown_ = std::current_exception();
  }
  /// Keeps a term that was not finite.
  void keep(const Energy& term) {
    const std::lock_guard lock(mutex_);
    not_finite_ = &term;
  }
  std::exception_ptr thrown() const {
    const std::lock_guard lock(mutex_);
    return thrown_;
  }
  /// Forgets terms that were not finite, because a later step succeeded.
  void forget() {
    const std::lock_guard lock(mutex_);
    not_finite_ = nullptr;
  }
  /// The last term that was not finite; null if there was none.
  const Energy* not_finite() const {
    const std::lock_guard lock(mutex_);
    return not_finite_;
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    thrown_ = nullptr;
    not_finite_ = nullptr;
  }

 private:
  mutable std::mutex mutex_;
  std::exception_ptr thrown_;
  const Energy* not_finite_ = nullptr;
};

}  // namespace deformlab
