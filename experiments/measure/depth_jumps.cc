#include "experiments/measure/depth_jumps.h"

#include <algorithm>

namespace deformlab {

void DepthJumps::add(const Overlaps& overlaps, const Eigen::VectorXd& depths) {
  std::map<std::pair<int, int>, bool> now;
  for (const TrianglePair& pair : overlaps.pairs) {
    const auto [a, b] = std::minmax(pair.a, pair.b);
    const bool in_front = depths[a] > depths[b];
    now.emplace(std::pair(a, b), in_front);
    const auto before = first_in_front_.find({a, b});
    count_ += before != first_in_front_.end() && before->second != in_front;
  }
  first_in_front_.swap(now);
}

}  // namespace deformlab
