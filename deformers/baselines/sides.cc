#include "deformers/baselines/sides.h"

#include <algorithm>
#include <tuple>

namespace deformlab {

std::vector<Side> sorted_sides(const Eigen::Matrix3Xi& T) {
  std::vector<Side> sides;
  for (int t = 0; t < T.cols(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int from = T(k, t), to = T((k + 1) % 3, t);
      sides.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

}  // namespace deformlab
