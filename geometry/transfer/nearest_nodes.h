#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace deformlab {

/// The nodes nearest to points most of which lie near the one before: they are sought among the
/// neighbors of the last one's node, and in a tree of all nodes where that does not do.
class NearestNodes {
 public:
  /// g  3×m node positions [length], which must outlive this; count ≤ m nodes are sought.
  NearestNodes(const Eigen::Matrix3Xd& g, int count);
  ~NearestNodes();

  /// The nodes nearest to v and how far they are [length], nearest first.
  void find(const Eigen::Vector3d& v, int* nodes, double* distances);

 private:
  struct Tree;
  struct Neighbor {
    double distance;
    int node;
  };

  void query(const Eigen::Vector3d& v, int count, int* nodes, double* squares);
  const std::vector<Neighbor>& neighbors(int j);
  bool find_near(const Eigen::Vector3d& v);

  const Eigen::Matrix3Xd& g_;
  int count_;
  std::unique_ptr<Tree> tree_;
  std::vector<std::vector<Neighbor>> neighbors_;  // of a node, nearest first; empty until asked for
  std::vector<double> squares_;                   // of the distances of those that are sought,
  std::vector<int> nodes_;                        // and of the next one
  std::vector<Eigen::Index> found_;               // what the tree is asked for
  int last_ = -1;                                 // the node nearest to the last point
};

}  // namespace deformlab
