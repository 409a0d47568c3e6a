#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "energies/energy.h"
#include "solvers/linear/column_block.h"

namespace deformlab {

/// A symmetric matrix over the columns of X, to which elements are added. It has a dense block for
/// every two nodes that some element reads together. The time to find the blocks and to add to them
/// is linear in the number of elements.
class NodeBlocks {
 public:
  ///   first     Unknowns::first
  ///   energies  those that may be added; the functions below take the index of one of them
  NodeBlocks(const std::vector<int>& first, const std::vector<const Energy*>& energies);

  /// Adds w Σ a aᵀ over the elements of a Kronecker term.
  ///   a  the coefficients, one column for each element
  void add_kronecker(std::size_t energy, double weight, const Eigen::MatrixXd& a);
  /// Adds the mean diagonal of each d×d block of w JᵀJ.
  ///   JtJ  of every element, side by side
  void add_mean_diagonals(std::size_t energy, double weight, const Eigen::MatrixXd& JtJ);

  /// Adds 1 for every two columns that an element reads together.
  void add_structure(std::size_t energy);

  /// The lower triangle over the n columns of X that have a rank, in the order of their ranks. The
  /// others have the rank −1. Entries that are zero are left out, except on the diagonal.
  SparseMatrix lower(const std::vector<int>& rank, int n) const;

  /// Calls visit(p, q, value) for each entry of the lower triangle that is on the diagonal or not
  /// zero. p ≥ q are columns of X.
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
    std::vector<int> columns;          // how many columns each argument reads
    std::vector<int> elements, begin;  // the elements group after group, and where each one begins
    std::size_t first_pair;            // where the first group's pairs of arguments begin
  };

  static Groups group(const Energy& energy);
  void find_blocks();
  void add(const Groups& groups, int group, const Eigen::MatrixXd& local);
  void add_block(int slot, bool transposed, const double* local, std::ptrdiff_t stride, int rows,
                 int columns);

  std::vector<int> first_;                  // the first column of each node
  std::vector<Groups> groups_;              // one for each energy
  std::vector<std::pair<int, int>> pairs_;  // the larger and the smaller node of two arguments
  std::vector<int> slot_of_;                // the block of each pair
  std::vector<std::pair<int, int>> nodes_;  // the nodes of each block, sorted by the smaller one
  std::vector<std::size_t> offset_;         // where each block's values begin, column-major
  std::vector<double> values_;
};

}  // namespace deformlab
