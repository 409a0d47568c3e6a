#pragma once

#include <Eigen/Core>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace deformlab {

/// The handles of each group (Handles::groups), by the groups' numbers. Without groups, each handle
/// is one by itself.
inline std::vector<std::vector<int>> handle_groups(Eigen::Index handles,
                                                   std::span<const int> groups) {
  std::map<int, std::vector<int>> by_number;
  for (int l = 0; l < handles; ++l) by_number[groups.empty() ? l : groups[l]].push_back(l);
  std::vector<std::vector<int>> result;
  for (auto& [number, its_handles] : by_number) result.push_back(std::move(its_handles));
  return result;
}

}  // namespace deformlab
