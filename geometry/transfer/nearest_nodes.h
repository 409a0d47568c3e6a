#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace deformlab {

/// Finds the nodes that are nearest to points, fast where most points lie near the point before.
/// The search looks among the neighbors of the last point's nearest node, and in a tree of all
/// nodes where these do not suffice.
class NearestNodes {
 public:
  /// Prepares a search for count ≤ m nodes. The positions g (3×m) [length] must outlive this
  /// object.
  NearestNodes(const Eigen::Matrix3Xd& g, int count);
  ~NearestNodes();

  /// Writes the nodes that are nearest to v and their distances [length], the nearest first.
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
  std::vector<std::vector<Neighbor>> neighbors_;  // of each node, nearest first; filled on demand
  std::vector<double> squares_;      // squared distances of the count + 1 nearest nodes
  std::vector<int> nodes_;           // these nodes
  std::vector<Eigen::Index> found_;  // the result of a query to the tree
  int last_ = -1;                    // the node that was nearest to the last point
};

}  // namespace deformlab
