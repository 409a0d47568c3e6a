#include "solvers/gauss_newton/linearization/node_blocks.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "geometry/core/simd_block.h"
#include "geometry/core/simd_dispatch.h"
#include "solvers/linear/sparse_matrix.h"

namespace deformlab {
namespace {

// Elements that read no more nodes are not grouped, because adding one is as fast as finding its
// group.
constexpr int kFewNodes = 2;

std::uint64_t hash(std::span<const int> nodes) {
  std::uint64_t h = 0;
  for (const int node : nodes) h = (h ^ static_cast<std::uint64_t>(node)) * 0x9e3779b97f4a7c15;
  return h ^ (h >> 32);
}

// The items in ascending order of their keys. Items with equal keys keep their order.
template <class Key>
std::vector<int> counting_sort(const std::vector<int>& items, int keys, Key&& key) {
  std::vector<int> begin(keys + 1, 0), sorted(items.size());
  for (const int i : items) ++begin[key(i) + 1];
  for (int k = 0; k < keys; ++k) begin[k + 1] += begin[k];
  for (const int i : items) sorted[begin[key(i)]++] = i;
  return sorted;
}

std::vector<int> numbers(std::size_t count) {
  std::vector<int> result(count);
  for (std::size_t i = 0; i < count; ++i) result[i] = static_cast<int>(i);
  return result;
}

// Adds the lower triangle of w Σ a aᵀ over some elements of n coefficients each. Some entries above
// the diagonal are written too, because four numbers are added at a time.
DEFORMLAB_SIMD_DISPATCH
void add_squares(const double* a, std::ptrdiff_t n, const int* elements, int count, double weight,
                 double* local) {
  for (int i = 0; i < count; ++i) {
    const double* own = a + n * elements[i];
    for (std::ptrdiff_t q = 0; q < n; ++q) {
      const double scaled = weight * own[q];
      if (scaled == 0) continue;
      std::ptrdiff_t p = q - q % 4;
      for (; p + 4 <= n; p += 4) simd_block(local + q * n + p).v += scaled * simd_block(own + p).v;
      for (; p < n; ++p) local[q * n + p] += scaled * own[p];
    }
  }
}

}  // namespace

NodeBlocks::NodeBlocks(const std::vector<int>& first, const std::vector<const Energy*>& energies)
    : first_(first) {
  for (const Energy* energy : energies) {
    Groups groups = group(*energy);
    groups.first_pair = pairs_.size();
    for (int a = 0; a < energy->arity(); ++a) groups.columns.push_back(energy->argument(a).count);
    for (std::size_t g = 0; g + 1 < groups.begin.size(); ++g) {
      const auto nodes = energy->nodes(groups.elements[groups.begin[g]]);
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        for (std::size_t b = 0; b <= a; ++b) {
          pairs_.emplace_back(std::max(nodes[a], nodes[b]), std::min(nodes[a], nodes[b]));
        }
      }
    }
    groups_.push_back(std::move(groups));
  }
  for (int j = 0; j + 1 < static_cast<int>(first.size()); ++j) pairs_.emplace_back(j, j);
  find_blocks();
}

// Finds the groups with a hash table that uses open addressing.
NodeBlocks::Groups NodeBlocks::group(const Energy& energy) {
  const int count = energy.size();
  if (energy.arity() <= kFewNodes) return {&energy, {}, numbers(count), numbers(count + 1), 0};
  std::size_t size = 16;
  while (size < 2 * static_cast<std::size_t>(count)) size *= 2;
  std::vector<int> table(size, -1), group_of(count), first;
  for (int e = 0; e < count; ++e) {
    const auto nodes = energy.nodes(e);
    std::size_t at = hash(nodes) & (size - 1);
    while (table[at] >= 0 && !std::ranges::equal(energy.nodes(first[table[at]]), nodes)) {
      at = (at + 1) & (size - 1);
    }
    if (table[at] < 0) {
      table[at] = static_cast<int>(first.size());
      first.push_back(e);
    }
    group_of[e] = table[at];
  }
  std::vector<int> begin(first.size() + 1, 0);
  for (const int g : group_of) ++begin[g + 1];
  for (std::size_t g = 0; g < first.size(); ++g) begin[g + 1] += begin[g];
  return {&energy,
          {},
          counting_sort(numbers(count), static_cast<int>(first.size()),
                        [&](int e) { return group_of[e]; }),
          std::move(begin),
          0};
}

void NodeBlocks::find_blocks() {
  const int m = static_cast<int>(first_.size()) - 1;
  std::vector<int> order = numbers(pairs_.size());
  order = counting_sort(order, m, [&](int i) { return pairs_[i].first; });
  order = counting_sort(order, m, [&](int i) { return pairs_[i].second; });
  slot_of_.resize(pairs_.size());
  std::size_t size = 0;
  for (const int i : order) {
    if (nodes_.empty() || nodes_.back() != pairs_[i]) {
      const auto [j, k] = pairs_[i];
      nodes_.push_back(pairs_[i]);
      offset_.push_back(size);
      size += std::size_t(first_[j + 1] - first_[j]) * (first_[k + 1] - first_[k]);
    }
    slot_of_[i] = static_cast<int>(nodes_.size()) - 1;
  }
  values_.assign(size, 0);
}

void NodeBlocks::add_block(int slot, bool transposed, const double* local, std::ptrdiff_t stride,
                           int rows, int columns) {
  const int height = first_[nodes_[slot].first + 1] - first_[nodes_[slot].first];
  double* block = values_.data() + offset_[slot];
  for (int q = 0; q < columns; ++q, local += stride) {
    for (int p = 0; p < rows; ++p) block[transposed ? p * height + q : q * height + p] += local[p];
  }
}

// Adds the lower triangle of a symmetric matrix over the columns that the elements of a group read,
// in the order of their arguments.
void NodeBlocks::add(const Groups& groups, int group, const Eigen::MatrixXd& local) {
  const auto arity = static_cast<int>(groups.columns.size());
  const auto nodes = groups.energy->nodes(groups.elements[groups.begin[group]]);
  const int* slot =
      slot_of_.data() + groups.first_pair + std::size_t(group) * arity * (arity + 1) / 2;
  for (int a = 0, row = 0; a < arity; row += groups.columns[a++]) {
    for (int b = 0, column = 0; b <= a; column += groups.columns[b++], ++slot) {
      const double* block = &local(row, column);
      const int rows = groups.columns[a], columns = groups.columns[b];
      add_block(*slot, nodes[a] < nodes[b], block, local.rows(), rows, columns);
      const bool twice = a != b && nodes[a] == nodes[b];  // an element that reads a node twice
      if (twice) add_block(*slot, true, block, local.rows(), rows, columns);
    }
  }
}

void NodeBlocks::add_kronecker(std::size_t energy, double weight, const Eigen::MatrixXd& a) {
  const Groups& groups = groups_[energy];
  Eigen::MatrixXd local(a.rows(), a.rows());
  for (int g = 0; g + 1 < static_cast<int>(groups.begin.size()); ++g) {
    local.setZero();
    add_squares(a.data(), a.rows(), groups.elements.data() + groups.begin[g],
                groups.begin[g + 1] - groups.begin[g], weight, local.data());
    add(groups, g, local);
  }
}

void NodeBlocks::add_mean_diagonals(std::size_t energy, double weight, const Eigen::MatrixXd& JtJ) {
  const Groups& groups = groups_[energy];
  const int d = groups.energy->dimension(), width = groups.energy->jacobian_columns();
  Eigen::MatrixXd local(width / d, width / d);
  for (int g = 0; g + 1 < static_cast<int>(groups.begin.size()); ++g) {
    local.setZero();
    for (int i = groups.begin[g]; i < groups.begin[g + 1]; ++i) {
      const auto element = JtJ.middleCols(std::ptrdiff_t(groups.elements[i]) * width, width);
      for (int q = 0; q < local.cols(); ++q) {
        for (int p = 0; p < local.rows(); ++p) {
          local(p, q) += weight / d * element.block(d * p, d * q, d, d).trace();
        }
      }
    }
    add(groups, g, local);
  }
}

void NodeBlocks::add_structure(std::size_t energy) {
  const Groups& groups = groups_[energy];
  const int n = groups.energy->jacobian_columns() / groups.energy->dimension();
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(n, n);
  for (int g = 0; g + 1 < static_cast<int>(groups.begin.size()); ++g) add(groups, g, ones);
}

SparseMatrix NodeBlocks::lower(const std::vector<int>& rank, int n) const {
  std::vector<SparseEntry> entries;
  entries.reserve(values_.size() / 2);
  for_each([&](int p, int q, double value) {
    if (rank[p] < 0 || rank[q] < 0) return;
    entries.push_back({std::max(rank[p], rank[q]), std::min(rank[p], rank[q]), value});
  });
  return sparse_matrix(entries, n);
}

}  // namespace deformlab
