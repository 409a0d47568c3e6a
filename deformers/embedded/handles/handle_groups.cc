#include "deformers/embedded/handles/handle_groups.h"

#include <Eigen/SVD>
#include <map>
#include <utility>

namespace deformlab {

std::vector<std::vector<int>> handle_groups(Eigen::Index handles, std::span<const int> groups) {
  std::map<int, std::vector<int>> by_number;
  for (int l = 0; l < handles; ++l) by_number[groups.empty() ? l : groups[l]].push_back(l);
  std::vector<std::vector<int>> result;
  for (auto& [number, its_handles] : by_number) result.push_back(std::move(its_handles));
  return result;
}

bool spans_a_plane(const Eigen::Matrix3Xd& points, double flat) {
  if (points.cols() < 3) return false;
  const Eigen::Matrix3Xd arms = points.colwise() - points.rowwise().mean();
  const Eigen::Vector3d s = Eigen::JacobiSVD<Eigen::Matrix3d>(arms * arms.transpose())
                                .singularValues();  // squares of those of the arms
  return s[1] > flat * flat * s[0];
}

}  // namespace deformlab
