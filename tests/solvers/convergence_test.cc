#include <gtest/gtest.h>

#include "solvers/solver.h"

namespace deformlab {
namespace {

constexpr double kEpsilon = 1e-6;  // its cube root is 0.01

// Eq. 12: |F − F'| < ε (1 + F), ‖∇F‖∞ < ∛ε (1 + F), ‖δ‖∞ < ∛ε (1 + ‖δ‖∞).
TEST(Converged, NeedsAllThreeConditions) {
  EXPECT_TRUE(converged(1, 1 + 1.9e-6, 0.019, 0.0099, kEpsilon));
  EXPECT_FALSE(converged(1, 1 + 2.1e-6, 0.019, 0.0099, kEpsilon));
  EXPECT_FALSE(converged(1, 1 + 1.9e-6, 0.021, 0.0099, kEpsilon));
  EXPECT_FALSE(converged(1, 1 + 1.9e-6, 0.019, 0.0102, kEpsilon));
}

TEST(Converged, CountsARiseAsAChange) {
  EXPECT_FALSE(converged(1, 1 - 2.1e-6, 0, 0, kEpsilon));
  EXPECT_TRUE(converged(1, 1 - 1.9e-6, 0, 0, kEpsilon));
}

TEST(Converged, IsRelativeToALargeCost) {
  EXPECT_TRUE(converged(1e6, 1e6 + 0.9, 9000, 0, kEpsilon));
  EXPECT_FALSE(converged(1e6, 1e6 + 1.1, 9000, 0, kEpsilon));
  EXPECT_FALSE(converged(1e6, 1e6 + 0.9, 11000, 0, kEpsilon));
}

TEST(Converged, NeverOnWhatIsNotANumber) {
  EXPECT_FALSE(converged(NAN, 1, 0, 0, kEpsilon));
  EXPECT_FALSE(converged(1, NAN, 0, 0, kEpsilon));
  EXPECT_FALSE(converged(1, 1, NAN, 0, kEpsilon));
  EXPECT_FALSE(converged(1, 1, 0, NAN, kEpsilon));
}

}  // namespace
}  // namespace deformlab
