#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "energies/energy.h"
#include "solvers/linear/column_block.h"

namespace deformlab {

/// A symmetric matrix over the columns of X while it is summed up: one dense block for every two
/// nodes that some element reads together. Finding them and adding to them takes a time linear in
/// the elements.
class NodeBlocks {
 public:
  /// Of a problem whose nodes have the columns `first` (Unknowns::first). `energies` are all that
  /// may be added, each by its place among them.
  NodeBlocks(const std::vector<int>& first, const std::vector<const Energy*>& energies);

  /// Adds w Σ a aᵀ over the elements of a Kronecker term.
  ///   a  coefficients as Energy has them.
  void add_kronecker(std::size_t energy, double weight, const Eigen::MatrixXd& a);
  /// Adds the d×d blocks of w JᵀJ, each by its mean diagonal.
  ///   JtJ  of every element, side by side.
  void add_mean_diagonals(std::size_t energy, double weight, const Eigen::MatrixXd& JtJ);

  /// Adds 1 to every two columns that an element reads together.
  void add_structure(std::size_t energy);

  /// The lower triangle over those columns of X that have a rank (0 … n − 1; the others −1), put
  /// in the order of their ranks. Zeros leave no trace, but the diagonal is there.
  SparseMatrix lower(const std::vector<int>& rank, int n) const;

  /// visit(p, q, value) for the entries of the lower triangle that are not zero, by columns of X,
  /// and those of the diagonal.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t s = 0; s < nodes_.size(); ++s) {
      const auto [j, k] = nodes_[s];
      const double* value = values_.data() + offset_[s];
      for (int q = first_[k]; q < first_[k + 1]; ++q) {
        for (int p = first_[j]; p < first_[j + 1]; ++p, ++value) {
          if (p >= q && (*value != 0 || p == q)) visit(p, q, *value);
        }
      }
    }
  }

 private:
  // The elements of an energy that read the same nodes, in the same order.
  struct Groups {
    const Energy* energy;
    std::vector<int> columns;          // that each argument reads
    std::vector<int> elements, begin;  // group after group
    std::size_t first_pair;            // of the first group's pairs of arguments
  };

  static Groups group(const Energy& energy);
  void find_blocks();
  void add(const Groups& groups, int group, const Eigen::MatrixXd& local);
  void add_block(int slot, bool transposed, const double* local, std::ptrdiff_t stride, int rows,
                 int columns);

  std::vector<int> first_;                  // column of each node
  std::vector<Groups> groups_;              // one an energy
  std::vector<std::pair<int, int>> pairs_;  // (larger, smaller) node of each two arguments
  std::vector<int> slot_of_;                // and its block
  std::vector<std::pair<int, int>> nodes_;  // of each block, sorted by the smaller one
  std::vector<std::size_t> offset_;         // of each block's values, which are column-major
  std::vector<double> values_;
};

}  // namespace deformlab
