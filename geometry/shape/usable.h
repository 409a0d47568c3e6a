#pragma once

#include <Eigen/Core>
#include <string>

namespace deformlab {

/// Throws InputError: cannot use 'NAME': WHAT.
[[noreturn]] void cannot_use(const std::string& name, const std::string& what);

/// The fourth power of a length, which occurs in areas and energies, must be in a double's range.
/// Throws InputError if the points (one in each column) reach further than kMostLength from the
/// origin, or if they are not all equal and less than kLeastLength across. They must be finite.
void check_extent(const Eigen::Ref<const Eigen::MatrixXd>& points, const std::string& name);

}  // namespace deformlab
