#pragma once

#include <fmt/format.h>

#include <string>

namespace deformlab::test {

/// The files that the command line's tests begin with: small, so that a run takes milliseconds.

/// n×n vertices over [0, side]², row by row along x, quads.
inline std::string plane_off(int n = 9, double side = 1) {
  std::string text =
      "OFF\n" + std::to_string(n * n) + " " + std::to_string((n - 1) * (n - 1)) + " 0\n";
  for (int i = 0; i < n * n; ++i) {
    const int column = i % n, row = i / n;
    text += fmt::format("{:f} {:f} 0\n", side * column / (n - 1), side * row / (n - 1));
  }
  for (int a = 0; a + n < n * n; ++a) {
    if (a % n == n - 1) continue;
    text += "4 " + std::to_string(a) + " " + std::to_string(a + 1) + " " +
            std::to_string(a + 1 + n) + " " + std::to_string(a + n) + "\n";
  }
  return text;
}

/// Pins the left edge of such a plane of side 1 and lifts the right one.
inline constexpr const char* kLift = R"(edit:
  - select: {box: {min: [-1, -1, -1], max: [0.01, 2, 1]}}
    fix: true
  - select: {box: {min: [0.99, -1, -1], max: [2, 2, 1]}}
    by: [0, 0, 0.3]
)";

/// The same as an experiment.
inline const std::string kExperiment = std::string(R"(title: a small plane
shape: {columns: 9, rows: 9}
graph: {nodes: 20}
picture: {width: 60, height: 40}
)") + kLift;

}  // namespace deformlab::test
